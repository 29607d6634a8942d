#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/figures.hpp"
#include "reports/records/directory/run_files.hpp"

namespace reports {
namespace {

constexpr std::size_t marks_a_run = 40, line_points = 600;

// About `count` points, evenly spaced in time whatever the spacing of the rows. `phase` in [0, 1) shifts them
// by a part of their distance, so that the marks of runs that agree do not hide each other.
Curve evenly_in_time(const Curve& curve, std::size_t count, double phase) {
  if (curve.size() <= count) return curve;
  const double begin = curve.front().first;
  const double distance = (curve.back().first - begin) / static_cast<double>(count - 1);
  Curve few;
  double next = begin + phase * distance;
  for (const auto& point : curve) {
    if (point.first < next) continue;
    few.push_back(point);
    while (next <= point.first && distance > 0) next += distance;
  }
  return few;
}

}  // namespace

Figure history_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results) {
  const bool energy = record.kind == "energy";
  const std::vector<LabelledRun> runs = runs_of(record, results);
  std::vector<Curve> measured, exact;
  double largest = 0;
  for (const LabelledRun& run : runs) {
    Curve& points = measured.emplace_back();
    Curve& line = exact.emplace_back();
    for (const HistoryRow& row : read_history(dir, run.run->run)) {
      if (!std::isfinite(row.t)) continue;
      points.emplace_back(row.t, energy ? row.kinetic_energy : row.probe);
      line.emplace_back(row.t, energy ? row.kinetic_energy_exact : row.probe_exact);
      for (const double value : {points.back().second, line.back().second}) {
        if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
      }
    }
  }
  const Unit unit = energy ? Unit{1, "J/m"} : readable_length(largest);
  // The probe of a channel is at mid-height; other scenes have theirs elsewhere.
  const bool channels = std::all_of(runs.begin(), runs.end(), [](const LabelledRun& run) {
    return run.run->scene.ends_with("poiseuille") || run.run->scene == "couette";
  });
  FigureScript script(
      record.title, "t [s]",
      energy ? "kinetic energy [J/m]"
             : fmt::format("velocity at {} [{}/s]", channels ? "mid-height" : "the probe", unit.name));
  const bool one_line = coincide(exact, largest);
  bool any_exact = false;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (Curve* curve : {&measured[r], &exact[r]}) {
      for (auto& point : *curve) point.second *= unit.factor;
    }
    any_exact = any_exact || std::any_of(exact[r].begin(), exact[r].end(),
                                         [](const auto& p) { return std::isfinite(p.second); });
    const std::string colour = curve_colour(r);
    if (!one_line || r == 0)
      script.line(thinned(exact[r], line_points), one_line ? "#000000" : colour, "", 1.3);
    const double phase = static_cast<double>(r) / static_cast<double>(runs.size());
    script.points(evenly_in_time(measured[r], marks_a_run, phase), colour, curve_mark(r).filled,
                  runs.size() == 1 && record.labels.empty() ? method_of(runs) : runs[r].label, 0.7);
  }
  Figure figure;
  if (script.empty()) return figure;
  if (any_exact) script.legend_line(one_line ? "#000000" : "#555555", solution_name(runs), 1.3);
  figure.script = script.text(record.figure);
  figure.caption = any_exact
                       ? fmt::format("Lines: {} solution. Marks: {}, about 40 of its recorded times.",
                                     solution_name(runs), method_of(runs))
                       : fmt::format("Marks: {}, about 40 of its recorded times; no exact solution is known.",
                                     method_of(runs));
  return figure;
}

}  // namespace reports
