#include "reports/pages/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/pages/report_markdown.hpp"
#include "reports/pages/sections/controls.hpp"
#include "reports/records/changes.hpp"
#include "reports/records/chapters.hpp"

namespace reports {
namespace {

/// A text from a user's file, cut where it would fill a screen. Cut between characters, not inside of one.
std::string brief(const std::string& text, std::size_t most) {
  if (text.size() <= most) return markdown_text(text);
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return markdown_text(text.substr(0, end)) + "...";
}

std::string failure_rows(const ReportData& data, std::size_t room) {
  const auto failed = failures(data.results);
  if (failed.empty()) return "";
  std::string text =
      "\n## Failures\n\n| study | check | observed | bounds | reason for the bounds "
      "|\n|---|---|---|---|---|\n";
  std::size_t shown = 0;
  for (const CheckRecord* check : failed) {
    const std::string row =
        fmt::format("| {} | {} | **{}** | {} | {} |\n", brief(check->study, 80), brief(check->check, 160),
                    brief(with_unit(observed(*check), *check), 60),
                    brief(with_unit(bounds(*check), *check), 80), brief(check->reason, 200));
    if (text.size() + row.size() > room) break;
    text += row;
    ++shown;
  }
  if (shown < failed.size())
    text += fmt::format("\n{} more failures in checks.csv.\n", failed.size() - shown);
  return text;
}

std::string topic_rows(const ReportData& data, std::size_t room) {
  std::string text = "\n## Topics\n\n| verdict | topic | studies | checks |\n|---|---|---|---|\n";
  for (const Chapter& chapter : chapters_of(data)) {
    std::size_t all = 0, held = 0;
    for (const StudyRecord& study : chapter.studies)
      for (const CheckRecord* check : checks_of(data.results, study.study)) {
        ++all;
        held += holds(*check);
      }
    const std::string row =
        fmt::format("| {} | {} | {} | {} of {} |\n", all > 0 && held == all ? "pass" : "**FAIL**",
                    brief(chapter.title, 80), chapter.studies.size(), held, all);
    if (text.size() + row.size() > room) return text + "\nMore topics in report.html.\n";
    text += row;
  }
  return text;
}

std::string headline_rows(const ReportData& data) {
  std::string text;
  for (const Headline& headline : headlines_of(data, 6)) {
    const std::string low = number(headline.lowest, 3), high = number(headline.highest, 3);
    text += fmt::format("| {} | {} | {} |\n", brief(headline.title, 120),
                        brief(with_unit(low == high ? low : low + " to " + high, *headline.decisive), 80),
                        brief(bounds(*headline.decisive), 80));
  }
  return text.empty() ? "" : "\n## Numbers\n\n| what | measured | required |\n|---|---|---|\n" + text;
}

}  // namespace

std::string markdown_summary(const ReportData& data) {
  std::string text =
      "# " + verdict_line(data.results) + "\n\nThe whole report is report.html beside this file.";
  if (data.provenance)
    text += fmt::format(" mpm-verify {} ({}), {}.", brief(data.provenance->build.version, 40),
                        brief(data.provenance->build.commit, 60), brief(data.provenance->started, 40));
  text += "\n\nSince the last run: " + brief(changes_line(data.changes), 300) + ".\n";
  if (const std::string controls = controls_line(data.results.controls); !controls.empty())
    text += "\n" + controls + ".\n";
  // Failures may take most of the room; the parts after them are bounded each.
  text += failure_rows(data, summary_limit / 2);
  std::size_t warned = 0;
  for (const std::string& warning : data.warnings) {
    if (++warned == 1) text += "\n## Warnings\n\n";
    if (warned > 10) {
      text += fmt::format("- {} more\n", data.warnings.size() - 10);
      break;
    }
    text += "- " + brief(warning, 300) + "\n";
  }
  return text + topic_rows(data, summary_limit / 5) + headline_rows(data);
}

}  // namespace reports
