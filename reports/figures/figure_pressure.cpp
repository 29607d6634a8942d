#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/figures.hpp"
#include "reports/records/directory/run_files.hpp"

namespace reports {

Figure pressure_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results) {
  const std::vector<LabelledRun> runs = runs_of(record, results);
  const bool across_x = record.across == "x";
  std::vector<Curve> exact, measured;
  double largest_place = 0, largest = 0;
  for (const LabelledRun& run : runs) {
    Curve& line = exact.emplace_back();
    Curve& points = measured.emplace_back();
    for (const StateRow& row : read_state(dir, run.run->run)) {
      if (row.t != record.t) continue;
      const double place = across_x ? row.x : row.y;
      largest_place = std::max(largest_place, place);
      if (row.location == "exact")
        line.emplace_back(place, row.pressure_exact);
      else
        points.emplace_back(place, row.pressure);
      if (std::isfinite(row.pressure_exact)) largest = std::max(largest, std::abs(row.pressure_exact));
    }
    std::sort(points.begin(), points.end());
  }
  const Unit length = readable_length(largest_place);
  FigureScript script(record.title, fmt::format("{} [{}]", record.across, length.name), "pressure [Pa]");
  const bool one_line = coincide(exact, largest);
  bool any_exact = false;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (Curve* curve : {&exact[r], &measured[r]})
      for (auto& point : *curve) point.first *= length.factor;
    any_exact = any_exact || !exact[r].empty();
    if (!one_line || r == 0) script.line(exact[r], one_line ? "#000000" : curve_colour(r), "", 1.3);
    script.points(measured[r], curve_colour(r), curve_mark(r).filled, runs[r].label, 0.7);
  }
  Figure figure;
  if (script.empty()) return figure;
  if (any_exact) script.legend_line(one_line ? "#000000" : "#555555", "exact", 1.3);
  figure.script = script.text(record.figure);
  figure.caption =
      fmt::format("t = {:.4g} s. Line: exact solution. Marks: particles of {}.", record.t, method_of(runs));
  return figure;
}

}  // namespace reports
