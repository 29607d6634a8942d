#include "reports/pages/sections/controls.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/pages/html/page.hpp"
#include "reports/pages/report_markdown.hpp"

namespace reports {
namespace {

/// The sound solver among them is no fault.
bool plants_a_fault(const ControlRecord& control) {
  return !control.must_fail.empty();
}

std::string wanted(const ControlRecord& control) {
  return plants_a_fault(control) ? control.must_fail : "nothing";
}

std::string found(const ControlRecord& control) {
  return control.said.empty() ? "nothing" : control.said;
}

}  // namespace

std::string controls_line(const std::vector<ControlRecord>& controls) {
  if (controls.empty()) return "";
  const auto faults = std::ranges::count_if(controls, plants_a_fault);
  const auto seen =
      std::ranges::count_if(controls, [](const auto& c) { return plants_a_fault(c) && c.seen; });
  return fmt::format("Negative controls: {} of {} planted faults were seen", seen, faults);
}

std::string html_controls(const std::vector<ControlRecord>& controls) {
  if (controls.empty()) return "";
  std::string rows;
  for (const ControlRecord& control : controls)
    rows += fmt::format(
        "<tr><td class=\"{}\">{}</td><td class=\"w\"><a href=\"{}/report.html\">{}</a></td><td "
        "class=\"w\" data-label=\"must be red\">{}</td><td class=\"w\" data-label=\"was red\">{}</td><td "
        "class=\"n\" data-label=\"exit code\">{}</td></tr>\n",
        control.seen ? "pass" : "fail", control.seen ? "seen" : "NOT SEEN", html_text(control.results),
        html_text(control.planted), html_text(wanted(control)), html_text(found(control)), control.exit_code);
  return "<section id=\"controls\">\n<h3>" + html_text(controls_line(controls)) + "</h3>\n" +
         html_table(
             "<th>verdict</th><th>planted</th><th>must be red</th><th>was red, and what it observed</th><th "
             "class=\"n\">exit code</th>",
             rows, "cards") +
         "</section>\n";
}

std::string markdown_controls(const std::vector<ControlRecord>& controls) {
  if (controls.empty()) return "";
  std::string text =
      "\n## Negative controls\n\n" + controls_line(controls) +
      ".\n\n| verdict | planted | must be red | was red | exit code |\n|---|---|---|---|---|\n";
  for (const ControlRecord& control : controls)
    text += fmt::format("| {} | {} | {} | {} | {} |\n", control.seen ? "seen" : "**NOT SEEN**",
                        markdown_text(control.planted), markdown_text(wanted(control)),
                        markdown_text(found(control)), control.exit_code);
  return text;
}

}  // namespace reports
