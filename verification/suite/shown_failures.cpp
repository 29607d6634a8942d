#include "verification/suite/shown_failures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "reports/files/atomic_file.hpp"
#include "verification/not_a_number.hpp"

namespace verification {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

std::size_t lines_that_begin(const std::string& text, const std::string& begin) {
  return count("\n" + text, "\n" + begin);
}

/// The part of a text from one mark to the next, or to its end; "" without the first.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == text.npos) return "";
  return text.substr(from, text.find(end, from + begin.size()) - from);
}

/// The verdict as the tables have it. It is made here anew: the reports' own words are what is judged.
std::string verdict_of(const reports::Results& results, std::size_t failed) {
  const std::size_t all = results.checks.size();
  return fmt::format("{}: {} of {} checks hold", failed == 0 && all > 0 ? "PASS" : "FAIL", all - failed, all);
}

double if_so(bool holds, std::size_t number) {
  return holds ? static_cast<double>(number) : nan;
}

}  // namespace

std::vector<Shown> shown_failures(const std::filesystem::path& dir, const std::string& printed,
                                  const reports::Results& results) {
  const auto failed = static_cast<std::size_t>(
      std::ranges::count_if(results.checks, [](const auto& check) { return check.verdict != "pass"; }));
  const std::string verdict = verdict_of(results, failed);
  const std::string junit = reports::read_file(dir / "junit.xml"),
                    page = reports::read_file(dir / "report.html"),
                    report = reports::read_file(dir / "report.md"),
                    summary = reports::read_file(dir / "summary.md");
  std::vector<Shown> shown;
  shown.push_back({"the console",
                   if_so(lines_that_begin(printed, verdict) == 1, lines_that_begin(printed, "FAIL  ")), nan});

  const std::size_t failures = count(junit, "<failure "), errors = count(junit, "<error ");
  const std::string totals =
      fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\"", results.checks.size(), failures, errors);
  // One study: the totals of its suite are those of the file.
  shown.push_back({"junit.xml", if_so(count(junit, totals) == 2, failures + errors), nan});

  const std::string in_summary = between(summary, "\n## Failures\n", "\n## ");
  shown.push_back({"summary.md",
                   if_so(summary.starts_with("# " + verdict + "\n"),
                         failed == 0 ? count(in_summary, "\n| ")
                                     : std::max<std::size_t>(1, count(in_summary, "\n| ")) - 1),
                   nan});
  const std::string in_report = between(report, "\n## Failures\n", "\n## ");
  shown.push_back({"report.md",
                   if_so(report.starts_with("# " + verdict + "\n"), count(in_report, "\n| **FAIL** |")),
                   static_cast<double>(count(report, "(**not borne out**)"))});
  const std::string on_page = between(page, "<section id=\"failures\">", "</section>");
  const char* banner = failed == 0 ? "<header class=\"banner pass\"" : "<header class=\"banner fail\"";
  shown.push_back({"report.html",
                   if_so(count(page, banner) == 1 && count(page, "<h1>" + verdict + "</h1>") == 1,
                         count(on_page, "<td class=\"fail\">FAIL</td>")),
                   static_cast<double>(count(page, "(not borne out: a check behind it fails)"))});
  return shown;
}

}  // namespace verification
