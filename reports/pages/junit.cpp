#include "reports/pages/junit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reports/records/report_data.hpp"

namespace reports {
namespace {

// Length in bytes of the well-formed UTF-8 character at `i`, 0 if there is none.
std::size_t character_length(const std::string& text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
  const auto follows = [&](std::size_t k) { return (byte(k) & 0xc0u) == 0x80u; };
  const unsigned first = byte(i), second = byte(i + 1);
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first <= 0xdf) return follows(i + 1) ? 2 : 0;
  if (first >= 0xe0 && first <= 0xef) {
    const bool overlong = first == 0xe0 && second < 0xa0, surrogate = first == 0xed && second >= 0xa0;
    const bool noncharacter = first == 0xef && second == 0xbf && byte(i + 2) >= 0xbe;
    return follows(i + 1) && follows(i + 2) && !overlong && !surrogate && !noncharacter ? 3 : 0;
  }
  if (first >= 0xf0 && first <= 0xf4) {
    const bool outside = (first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90);
    return follows(i + 1) && follows(i + 2) && follows(i + 3) && !outside ? 4 : 0;
  }
  return 0;
}

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
  double total = std::nan("");
  for (const StudyRecord& study : studies_of(results)) {
    const auto checks = checks_of(results, study.study);
    if (checks.empty()) continue;
    std::size_t failed = 0;
    std::string cases;
    for (const CheckRecord* check : checks) {
      cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", xml_text(check->study),
                           xml_text(check->check));
      if (holds(*check)) {
        cases += "/>\n";
        continue;
      }
      ++failed;
      cases += fmt::format(">\n      <failure type=\"check\" message=\"{}\">{}</failure>\n    </testcase>\n",
                           xml_text(fmt::format("observed {}, bounds {}", with_unit(observed(*check), *check),
                                                with_unit(bounds(*check), *check))),
                           xml_text(check->reason));
    }
    const double wall = wall_time_of(results, study.study);
    if (!std::isnan(wall)) total = (std::isnan(total) ? 0 : total) + wall;
    suites +=
        fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\"{}>\n{}",
                    xml_text(study.study), checks.size(), failed, time_attribute(wall), cases);
    suites += "  </testsuite>\n";
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites name=\"mpm-verify\" tests=\"{}\" failures=\"{}\" errors=\"0\"{}>\n{}</testsuites>\n",
      results.checks.size(), failures(results).size(), time_attribute(total), suites);
}

}  // namespace reports
