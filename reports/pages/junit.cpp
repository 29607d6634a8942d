#include "reports/pages/junit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reports/files/utf8.hpp"
#include "reports/records/report_data.hpp"

namespace reports {
namespace {

std::string time_attribute(double wall) {
  return std::isnan(wall) ? "" : fmt::format(" time=\"{:.6f}\"", wall);
}

}  // namespace

std::string xml_text(const std::string& text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    const char c = text[i];
    if (length > 1) {
      escaped.append(text, i, length);
    } else if (length == 0) {
      escaped += '?';
    } else if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '>') {
      escaped += "&gt;";
    } else if (c == '"') {
      escaped += "&quot;";
    } else if (c == '\'') {
      escaped += "&#39;";
    } else if (c == '\n' || c == '\t') {
      escaped += c;
    } else {
      escaped += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
    i += length ? length : 1;
  }
  return escaped;
}

std::string junit_report(const Results& results) {
  std::string suites;
  std::size_t all_failed = 0, all_errors = 0;
  double total = std::nan("");
  for (const StudyRecord& study : studies_of(results)) {
    const auto checks = checks_of(results, study.study);
    if (checks.empty()) continue;
    std::size_t failed = 0, errors = 0;
    std::string cases;
    const double wall = wall_time_of(results, study.study);
    // Runs serve all checks of their study: each has an equal share of their time, so that sums over cases
    // are right.
    const std::string share = time_attribute(wall / static_cast<double>(checks.size()));
    for (const CheckRecord* check : checks) {
      cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\"{}", xml_text(check->study),
                           xml_text(check->check), share);
      if (holds(*check)) {
        cases += "/>\n";
        continue;
      }
      // Nothing was observed, so nothing could be judged.
      const bool error = std::isnan(check->observed);
      ++(error ? errors : failed);
      cases += fmt::format(">\n      <{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n    </testcase>\n",
                           error ? "error" : "failure", error ? "not judged" : "check",
                           xml_text(fmt::format("observed {}, bounds {}", with_unit(observed(*check), *check),
                                                with_unit(bounds(*check), *check))),
                           xml_text(check->reason));
    }
    if (!std::isnan(wall)) total = (std::isnan(total) ? 0 : total) + wall;
    suites += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\"{}>\n{}",
        xml_text(study.study), checks.size(), failed, errors, time_attribute(wall), cases);
    all_failed += failed;
    all_errors += errors;
    suites += "  </testsuite>\n";
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites name=\"mpm-verify\" tests=\"{}\" failures=\"{}\" errors=\"{}\"{}>\n{}</testsuites>\n",
      results.checks.size(), all_failed, all_errors, time_attribute(total), suites);
}

}  // namespace reports
