#include "reports/summaries/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "reports/files/csv.hpp"
#include "reports/pages/html/page.hpp"
#include "reports/pages/report_markdown.hpp"
#include "reports/records/not_a_number.hpp"
#include "reports/records/report_data.hpp"

namespace reports {
namespace {

double component_of(const ErrorRecord& error, const std::string& norm) {
  return norm == "l1" ? error.l1 : norm == "linf" ? error.linf : error.l2;
}

double cost_of(const CostPoint& point, bool by_wall) {
  return by_wall ? point.wall : point.particle_steps;
}

const char* const work_precision_explanation =
    "Cheapest timed run of a flow and fluid whose L2 error on the grid is below the target at every output "
    "time: "
    "wall time of the simulation (fastest repetition after a warm-up, nothing else running), scheme, cells "
    "across, nominal dt, particle-steps. Other solvers, a row each, ran once, in a study that times ours. A "
    "dash: none of the runs made here reaches it.";

/// Who measured the time of a foreign run.
std::string clock_of(const CostPoint& point) {
  return point.clock == clock_solver ? "time as the solver says itself" : "time of its whole process";
}

std::string described(const CostPoint& point) {
  if (point.run->basis == foreign_scheme)
    return fmt::format("{} s: {} cells, dt {} s; {}", number(point.wall, 3), point.run->cells,
                       number(point.run->dt, 3), clock_of(point));
  return fmt::format("{} s: {}, {} cells, dt {} s, {} particle-steps", number(point.wall, 3),
                     scheme_of(*point.run), point.run->cells, number(point.run->dt, 3),
                     number(point.particle_steps, 3));
}

std::string headed(const Cheapest& table) {
  return table.scene + ", " + table.fluid + (table.solver.empty() ? "" : ", " + table.solver);
}

}  // namespace

const std::vector<double> error_targets = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6};

double error_of(const RunRecord& run, const Results& results, const std::string& location,
                const std::string& norm, double t) {
  if (!completed(run)) return nan;
  double worst = nan;
  for (const ErrorRecord& error : results.errors) {
    if (error.run != run.run || error.location != location) continue;
    if (!std::isnan(t) && error.t != t) continue;
    const double value = component_of(error, norm);
    if (!std::isfinite(value)) return nan;
    if (!(worst >= value)) worst = value;
  }
  return worst;
}

double particle_steps_of(const RunRecord& run) {
  if (run.particles == unknown_count || run.steps == unknown_count) return nan;
  return static_cast<double>(run.particles) * static_cast<double>(run.steps);
}

std::vector<CostPoint> best_front(std::vector<CostPoint> points, bool by_wall) {
  std::erase_if(points,
                [&](const CostPoint& p) { return !std::isfinite(p.error) || !(cost_of(p, by_wall) > 0); });
  std::ranges::stable_sort(points, [&](const CostPoint& a, const CostPoint& b) {
    return cost_of(a, by_wall) < cost_of(b, by_wall);
  });
  std::vector<CostPoint> front;
  for (const CostPoint& p : points)
    if (front.empty() || p.error < front.back().error) front.push_back(p);
  return front;
}

std::string scheme_of(const RunRecord& run) {
  if (run.basis == foreign_scheme) return run.method;
  const std::string method = run.method.empty() || run.method == "MPM" ? "" : run.method + ": ";
  return fmt::format("{}{}, {}, {}{}", method, run.basis, run.transfer, run.stepping,
                     run.reset == "never" ? "" : ", reset " + run.reset);
}

std::vector<Cheapest> cheapest_runs(const Results& results) {
  std::map<std::string, const TimingRecord*> timed, once;
  for (const TimingRecord& timing : results.timings)
    (timing.repetitions > 1 ? timed : once)[timing.run] = &timing;
  std::set<std::string> studies;
  for (const RunRecord& run : results.runs)
    if (timed.contains(run.run)) studies.insert(run.study);
  for (const RunRecord& run : results.runs)
    if (const auto timing = once.find(run.run);
        run.basis == foreign_scheme && studies.contains(run.study) && timing != once.end())
      timed.insert(*timing);
  std::vector<Cheapest> tables;
  for (const RunRecord& run : results.runs) {
    const auto timing = timed.find(run.run);
    if (timing == timed.end()) continue;
    const std::string solver = run.basis == foreign_scheme ? run.method : "";
    auto table = std::ranges::find_if(tables, [&](const Cheapest& c) {
      return c.scene == run.scene && c.fluid == run.fluid && c.solver == solver;
    });
    if (table == tables.end())
      table = tables.insert(tables.end(), {run.scene, run.fluid, solver,
                                           std::vector<CostPoint>(error_targets.size(), CostPoint{})});
    const CostPoint point{&run, timing->second->wall_s, particle_steps_of(run),
                          error_of(run, results, "grid", "l2", nan), timing->second->clock};
    for (std::size_t i = 0; i < error_targets.size(); ++i) {
      CostPoint& best = table->runs[i];
      if (point.error <= error_targets[i] && std::isfinite(point.wall) &&
          (best.run == nullptr || point.wall < best.wall))
        best = point;
    }
  }
  return tables;
}

std::string html_cheapest(const Results& results) {
  const auto tables = cheapest_runs(results);
  if (tables.empty()) return "";
  std::string head = "<th>flow, fluid</th>", rows;
  for (const double target : error_targets) head += "<th>" + number(target) + "</th>";
  for (const Cheapest& table : tables) {
    rows += "<tr><td>" + html_text(headed(table)) + "</td>";
    for (const CostPoint& point : table.runs)
      rows += "<td class=\"w\">" + (point.run ? html_text(described(point)) : "-") + "</td>";
    rows += "</tr>\n";
  }
  return "<section>\n<h3 id=\"cheapest\">Cheapest way to an error</h3>\n" + html_table(head, rows) +
         "<p class=\"faint\">" + std::string(work_precision_explanation) + "</p>\n</section>\n";
}

std::string markdown_cheapest(const Results& results) {
  const auto tables = cheapest_runs(results);
  if (tables.empty()) return "";
  std::string head = "| flow, fluid |", rule = "|---|", rows;
  for (const double target : error_targets) {
    head += " " + number(target) + " |";
    rule += "---|";
  }
  for (const Cheapest& table : tables) {
    rows += "| " + markdown_text(headed(table)) + " |";
    for (const CostPoint& point : table.runs)
      rows += " " + (point.run ? markdown_text(described(point)) : "-") + " |";
    rows += "\n";
  }
  return "\n## Cheapest way to an error\n\n" + head + "\n" + rule + "\n" + rows + "\n" +
         work_precision_explanation + "\n";
}

}  // namespace reports
