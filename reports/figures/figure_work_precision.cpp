#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/figures.hpp"
#include "reports/records/report_data.hpp"
#include "reports/summaries/work_precision.hpp"

namespace reports {
namespace {

constexpr double worst_time = std::numeric_limits<double>::quiet_NaN();  // see error_of()

struct Scheme {
  std::string name;
  std::vector<CostPoint> points;  // without errors: those belong to a panel
};

std::vector<Scheme> schemes_of(const FigureRecord& record, const Results& results) {
  const std::vector<LabelledRun> runs = runs_of(record, results);
  std::map<std::string, double> wall_of;
  for (const TimingRecord& timing : results.timings) wall_of[timing.run] = timing.wall_s;
  std::set<std::string> studies, fluids, scenes;
  for (const LabelledRun& r : runs) {
    studies.insert(r.run->study), fluids.insert(r.run->fluid), scenes.insert(r.run->scene);
  }
  std::vector<Scheme> schemes;
  for (const LabelledRun& r : runs) {
    const auto wall = wall_of.find(r.run->run);
    if (wall == wall_of.end()) continue;
    std::string name = scheme_of(*r.run);
    if (scenes.size() > 1) name += ", " + r.run->scene;
    if (fluids.size() > 1) name += ", " + r.run->fluid;
    if (studies.size() > 1) name += " (" + r.run->study + ")";
    if (!record.labels.empty()) name = r.label;
    auto found = std::ranges::find(schemes, name, &Scheme::name);
    if (found == schemes.end()) found = schemes.insert(schemes.end(), {name, {}});
    found->points.push_back({r.run, wall->second, particle_steps_of(*r.run), 0});
  }
  for (Scheme& scheme : schemes) {
    std::ranges::stable_sort(scheme.points, [](const CostPoint& a, const CostPoint& b) {
      return a.run->cells != b.run->cells ? a.run->cells < b.run->cells : a.run->dt > b.run->dt;
    });
  }
  return schemes;
}

/// An error of the size of the flow itself is none: the run has failed, whether it noticed or not.
constexpr double useless_error = 1;

std::vector<Scheme> with_errors(std::vector<Scheme> schemes, const Results& results,
                                const std::string& location, const std::string& norm, double t) {
  for (Scheme& scheme : schemes)
    for (CostPoint& point : scheme.points) {
      point.error = error_of(*point.run, results, location, norm, t);
      if (point.error > useless_error) point.error = std::numeric_limits<double>::quiet_NaN();
    }
  return schemes;
}

/// Whole decades around all errors, with room on top for what failed.
struct Range {
  double bottom, top;
};
Range range_of(const std::vector<std::vector<Scheme>>& panels) {
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (const auto& schemes : panels)
    for (const Scheme& scheme : schemes)
      for (const CostPoint& p : scheme.points) {
        if (!std::isfinite(p.error) || p.error <= 0) continue;
        lowest = std::min(lowest, p.error);
        highest = std::max(highest, p.error);
      }
  if (highest == 0) lowest = highest = 1;  // nothing but failures: they still are worth a diagram
  return {std::pow(10, std::floor(std::log10(lowest) - 0.1)),
          std::pow(10, std::ceil(std::log10(highest) + 0.3))};
}

/// One diagram. Says whether any run failed.
bool draw(FigureScript& script, const std::vector<Scheme>& schemes, const Range& range, bool by_wall) {
  const auto cost = [&](const CostPoint& p) { return by_wall ? p.wall : p.particle_steps; };
  script.logarithmic_x();
  script.logarithmic_y();
  script.y_range(range.bottom, range.top);
  script.statement("set format x '10^{%T}'");
  script.statement("set offsets graph 0.03, graph 0.03, 0, 0");
  std::vector<CostPoint> all;
  for (const Scheme& scheme : schemes) all.insert(all.end(), scheme.points.begin(), scheme.points.end());
  if (schemes.size() > 1) {
    Curve front;
    for (const CostPoint& p : best_front(all, by_wall)) front.emplace_back(cost(p), p.error);
    script.line(front, "#c8c8c8", "front of the best", 9);
  }
  bool any_failed = false;
  for (std::size_t i = 0; i < schemes.size(); ++i) {
    Curve good, failed;
    for (const CostPoint& p : schemes[i].points) {
      if (std::isfinite(p.error)) {
        good.emplace_back(cost(p), p.error);
      } else {
        failed.emplace_back(cost(p), range.top);
      }
    }
    any_failed = any_failed || !failed.empty();
    const std::string colour = curve_colour(i);
    script.line_and_points(good, colour, curve_mark(i).filled, schemes[i].name);
    constexpr int cross = 2;
    script.points(failed, colour, cross, good.empty() ? schemes[i].name : "", 1.4);
  }
  if (any_failed) script.legend_mark("#555555", 2, "failed: diverged, error above 1, or none known");
  return any_failed;
}

}  // namespace

Figure work_precision_figure(const FigureRecord& record, const Results& results) {
  const std::string location = locations_of(record).front(), norm = norm_of(record);
  const bool by_wall = record.across != "particle-steps";
  const std::vector<Scheme> schemes = schemes_of(record, results);
  std::set<std::string> runs;
  long repetitions = 0;
  for (const Scheme& scheme : schemes)
    for (const CostPoint& p : scheme.points) runs.insert(p.run->run);
  for (const TimingRecord& timing : results.timings)
    if (runs.contains(timing.run)) repetitions = std::max(repetitions, timing.repetitions);
  std::vector<double> times;
  for (const ErrorRecord& error : results.errors)
    if (runs.contains(error.run)) times.push_back(error.t);
  times = chosen_times(std::move(times), 5);
  if (times.size() < 2) times.clear();
  times.push_back(worst_time);

  std::vector<std::vector<Scheme>> panels;
  for (const double t : times) panels.push_back(with_errors(schemes, results, location, norm, t));
  const Range range = range_of(panels);
  std::vector<FigureScript> scripts;
  bool any_failed = false;
  for (std::size_t i = 0; i < times.size(); ++i) {
    scripts.emplace_back(
        std::isnan(times[i]) ? "largest of all output times" : "t = " + number(times[i]) + " s",
        by_wall ? "wall time of a run [s]" : "particle-steps [-]",
        fmt::format("relative {} error [-]", norm_symbol(norm)));
    any_failed = draw(scripts.back(), panels[i], range, by_wall) || any_failed;
  }
  Figure figure;
  if (std::ranges::all_of(scripts, &FigureScript::empty)) return figure;
  figure.script = panels_text(record.figure, record.title, scripts, std::min<std::size_t>(3, scripts.size()));
  figure.caption = fmt::format(
      "Error on {} against {}, a diagram an output time and one for the largest.",
      location == "grid" ? "the grid nodes" : "the " + location,
      !by_wall ? "particles times steps"
      : repetitions > 1
          ? fmt::format("the time of the whole run, the fastest of up to {} repetitions after a warm-up, "
                        "with no other run beside it",
                        repetitions)
          : "the time of the whole run, measured once while other runs shared the machine");
  if (schemes.size() > 1) figure.caption += " Grey band: runs that none other beats in both.";
  if (any_failed)
    figure.caption += " Crosses on the upper edge: failed runs: diverged, an error above 1, or none known.";
  return figure;
}

}  // namespace reports
