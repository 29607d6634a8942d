#include "reports/pages/sections/time_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "reports/files/csv.hpp"
#include "reports/pages/html/page.hpp"
#include "reports/pages/report_markdown.hpp"
#include "reports/records/report_data.hpp"

namespace reports {
namespace {

/// Of one variant of a study, coarse to fine.
struct Choice {
  std::string study, variant;
  std::vector<const TimeStepRecord*> levels;
  long pilots = 0;
  double pilot_work = 0, work = 0;  // particle-steps
};

std::vector<Choice> choices(const Results& results) {
  std::vector<Choice> found;
  if (results.time_steps.empty()) return found;
  std::map<std::string, double> work_of;
  for (const RunRecord& run : results.runs)
    work_of[run.run] = static_cast<double>(run.particles) * static_cast<double>(run.steps);
  for (const TimeStepRecord& step : results.time_steps) {
    if (found.empty() || found.back().study != step.study || found.back().variant != step.variant)
      found.push_back({step.study, step.variant, {}});
    found.back().levels.push_back(&step);
    found.back().work += work_of[step.run];
  }
  for (const PilotRecord& pilot : results.pilots)
    for (Choice& choice : found)
      if (choice.study == pilot.study && choice.variant == pilot.variant) {
        ++choice.pilots;
        choice.pilot_work += static_cast<double>(pilot.particles) * static_cast<double>(pilot.steps);
      }
  return found;
}

std::string steps_of(const Choice& choice) {
  std::string text;
  for (const TimeStepRecord* step : choice.levels)
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", number(step->dt, 3),
                        step->bound == "error" ? "" : " (" + step->bound + ")");
  return text;
}

std::string cost_of(const Choice& choice) {
  return fmt::format("{} runs, {} of {} particle-steps", choice.pilots, number(choice.pilot_work, 2),
                     number(choice.pilot_work + choice.work, 2));
}

std::string fraction_of(const Choice& choice) {
  return number(choice.levels.front()->fraction);
}

constexpr const char* time_steps_explanation =
    "dt: the longest step, coarse to fine, whose error in time is expected to stay the fraction of the error "
    "in "
    "space; in brackets what bounded it instead. Errors are L2 on the grid, the largest of all output times. "
    "Every number: time-steps.csv, pilots.csv.";

}  // namespace

std::string html_time_steps(const Results& results, const std::string& study) {
  std::string rows;
  for (const Choice& choice : choices(results)) {
    if (choice.study != study) continue;
    const bool none = choice.levels.front()->bound == no_step;
    rows += fmt::format(
        "<tr><td class=\"{}\">{}</td><td>{}</td><td class=\"n\">{}</td><td "
        "class=\"w\">{}</td><td>{}</td></tr>\n",
        none ? "fail" : "", html_text(choice.variant), html_text(steps_of(choice)), fraction_of(choice),
        html_text(choice.levels.front()->remark), html_text(cost_of(choice)));
  }
  if (rows.empty()) return "";
  return "<h4>Time steps by error</h4>\n" +
         html_table(
             "<th>variant</th><th>dt [s]</th><th class=\"n\">fraction</th><th>from</th><th>pilot runs</th>",
             rows) +
         "<p class=\"faint\">" + time_steps_explanation + "</p>\n";
}

std::string markdown_time_steps(const Results& results) {
  std::string rows;
  for (const Choice& choice : choices(results))
    rows += fmt::format("| {} | {} | {} | {} | {} | {} |\n", markdown_text(choice.study),
                        markdown_text(choice.variant), markdown_text(steps_of(choice)), fraction_of(choice),
                        markdown_text(choice.levels.front()->remark), markdown_text(cost_of(choice)));
  if (rows.empty()) return "";
  return "\n## Time steps by error\n\n| study | variant | dt [s] | fraction | from | pilot runs "
         "|\n|---|---|---|---|---|---|\n" +
         rows + "\n" + time_steps_explanation + "\n";
}

}  // namespace reports
