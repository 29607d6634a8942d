#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "reports/figure_script.hpp"
#include "reports/figures.hpp"
#include "reports/report_data.hpp"

namespace reports {
namespace {

struct Point {
  const RunRecord* run;
  double wall, error;  // error: NaN if the run did not complete
};

struct Scheme {
  std::string name;
  std::vector<Point> points;
};

double component_of(const ErrorRecord& error, const std::string& norm) {
  return norm == "l1" ? error.l1 : norm == "linf" ? error.linf : error.l2;
}

double worst_error(const RunRecord& run, const Results& results, const std::string& location,
                   const std::string& norm) {
  double worst = std::numeric_limits<double>::quiet_NaN();
  for (const ErrorRecord& error : results.errors) {
    if (error.run != run.run || error.location != location) continue;
    const double value = component_of(error, norm);
    if (!std::isfinite(value)) return std::numeric_limits<double>::quiet_NaN();
    if (!(worst >= value)) worst = value;
  }
  return worst;
}

std::vector<Scheme> schemes_of(const FigureRecord& record, const Results& results,
                               const std::string& location) {
  const std::vector<LabelledRun> runs = runs_of(record, results);
  const bool labelled = !record.labels.empty();
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
    std::string name = fmt::format("{}, {}, {}", r.run->basis, r.run->transfer, r.run->stepping);
    if (r.run->reset != "never") name += ", reset " + r.run->reset;
    if (scenes.size() > 1) name += ", " + r.run->scene;
    if (fluids.size() > 1) name += ", " + r.run->fluid;
    if (studies.size() > 1) name += " (" + r.run->study + ")";
    if (labelled) name = r.label;
    auto found =
        std::find_if(schemes.begin(), schemes.end(), [&](const Scheme& s) { return s.name == name; });
    if (found == schemes.end()) found = schemes.insert(schemes.end(), {name, {}});
    const double error = completed(*r.run) ? worst_error(*r.run, results, location, norm_of(record))
                                           : std::numeric_limits<double>::quiet_NaN();
    found->points.push_back({r.run, wall->second, error});
  }
  for (Scheme& scheme : schemes) {
    std::stable_sort(scheme.points.begin(), scheme.points.end(), [](const Point& a, const Point& b) {
      return a.run->cells != b.run->cells ? a.run->cells < b.run->cells : a.run->dt > b.run->dt;
    });
  }
  return schemes;
}

}  // namespace

Figure work_precision_figure(const FigureRecord& record, const Results& results) {
  const std::string location = locations_of(record).front();
  const std::vector<Scheme> schemes = schemes_of(record, results, location);
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (const Scheme& scheme : schemes) {
    for (const Point& p : scheme.points) {
      if (!std::isfinite(p.error) || p.error <= 0) continue;
      lowest = std::min(lowest, p.error);
      highest = std::max(highest, p.error);
    }
  }
  if (highest == 0) lowest = highest = 1;  // nothing but failures: they still are worth a diagram
  const double bottom = std::pow(10, std::floor(std::log10(lowest) - 0.1));
  const double top = std::pow(10, std::ceil(std::log10(highest) + 0.3));

  FigureScript script(record.title, "wall time of a run [s]",
                      fmt::format("relative {} error, worst output time [-]", norm_symbol(norm_of(record))));
  script.logarithmic_x();
  script.logarithmic_y();
  script.y_range(bottom, top);
  script.statement("set format x '10^{%T}'");
  script.statement("set offsets graph 0.03, graph 0.03, 0, 0");
  bool any_failed = false;
  for (std::size_t i = 0; i < schemes.size(); ++i) {
    Curve good, failed;
    for (const Point& p : schemes[i].points) {
      if (std::isfinite(p.error)) {
        good.emplace_back(p.wall, p.error);
      } else {
        failed.emplace_back(p.wall, top);
      }
    }
    any_failed = any_failed || !failed.empty();
    const std::string colour = curve_colour(i);
    script.line_and_points(good, colour, curve_mark(i).filled, schemes[i].name);
    constexpr int cross = 2;
    script.points(failed, colour, cross, good.empty() ? schemes[i].name : "", 1.4);
  }
  Figure figure;
  if (script.empty()) return figure;
  if (any_failed) script.legend_mark("#555555", 2, "diverged or no error known");
  figure.script = script.text(record.figure);
  figure.caption = fmt::format("Error on {}, worst of the output times, against the time of the whole run.",
                               location == "grid" ? "the grid nodes" : "the " + location);
  if (any_failed) figure.caption += " Crosses on the upper edge: runs that diverged or have no finite error.";
  return figure;
}

}  // namespace reports
