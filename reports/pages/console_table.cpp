#include "reports/pages/console_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/records/report_data.hpp"

namespace reports {
namespace {

constexpr std::size_t columns = 110;

// `text` cut or filled to `width` characters; a cut one ends in "~". Counts characters, not bytes, and keeps
// control characters from the terminal.
std::string fit(const std::string& text, std::size_t width) {
  std::vector<std::string> characters;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xc0) == 0x80 && !characters.empty()) {
      characters.back() += c;
    } else {
      characters.emplace_back(1, static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c);
    }
  }
  const bool cut = characters.size() > width;
  if (cut) characters.resize(width - 1), characters.emplace_back("~");
  std::string fitted;
  for (const std::string& c : characters) fitted += c;
  return fitted + std::string(width - characters.size(), ' ');
}

void trim_end(std::string& line) {
  line.erase(line.find_last_not_of(' ') + 1);
}

}  // namespace

std::string console_table(const std::vector<CheckRecord>& checks, bool colour, std::size_t unlisted) {
  const std::string green = colour ? "\033[32m" : "", red = colour ? "\033[1;31m" : "",
                    plain = colour ? "\033[0m" : "";
  std::size_t study_width = 5;
  for (const CheckRecord& check : checks) study_width = std::max(study_width, check.study.size());
  study_width = std::min<std::size_t>(study_width, 28);
  constexpr std::size_t observed_width = 16, bounds_width = 22;
  // "pass" and five gaps of two besides the columns.
  const std::size_t check_width = columns - 4 - 8 - study_width - observed_width - bounds_width;

  std::string table;
  const auto add_line = [&](const std::string& word, const std::string& paint, const std::string& study,
                            const std::string& name, const std::string& value, const std::string& limits) {
    std::string line = fmt::format("{}  {}  {}  {}", fit(study, study_width), fit(name, check_width),
                                   fit(value, observed_width), fit(limits, bounds_width));
    trim_end(line);
    table += paint + word + (paint.empty() ? "" : plain) + "  " + line + "\n";
  };
  const auto add_check = [&](const CheckRecord& check) {
    const bool good = holds(check);
    add_line(good ? "pass" : "FAIL", good ? green : red, check.study, check.check,
             with_unit(observed(check), check), bounds(check));
  };
  add_line("    ", "", "study", "check", "observed", "bounds");
  std::size_t held = 0;
  for (const CheckRecord& check : checks) {
    if (!holds(check)) continue;
    add_check(check);
    ++held;
  }
  for (const CheckRecord& check : checks) {
    if (holds(check)) continue;
    add_check(check);
    std::string clean;
    for (const char c : "bounds: " + check.reason)
      clean += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    std::string reason = wrap(clean, columns - 6);
    std::size_t begin = 0;
    while (begin <= reason.size()) {
      const std::size_t end = std::min(reason.find('\n', begin), reason.size());
      table += "      " + fit(reason.substr(begin, end - begin), columns - 6);
      trim_end(table);
      table += "\n";
      begin = end + 1;
    }
  }
  const bool good = !checks.empty() && held == checks.size();
  table +=
      (good ? green : red) + (good ? "PASS" : "FAIL") + plain +
      (checks.empty() ? ": no check was made\n"
                      : fmt::format(": {} of {} checks hold\n", held + unlisted, checks.size() + unlisted));
  return table;
}

}  // namespace reports
