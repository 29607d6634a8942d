#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "reports/compare/compare.hpp"
#include "reports/records/report_data.hpp"

namespace reports {
namespace {

/// "+12.3 %", or "x 1.8e+03" for a change beyond doubling.
std::string by_how_much(double before, double after) {
  if (!std::isfinite(before) || !std::isfinite(after)) return "";
  if (before == 0) return fmt::format("{:+.3g}", after - before);
  const double ratio = after / before;
  return ratio >= 0.5 && ratio <= 2 ? fmt::format("{:+.3g} %", 100 * (ratio - 1))
                                    : fmt::format("x {:.3g}", ratio);
}

/// Statements are 0 or 1: words say more.
std::string shown(const Measured& m) {
  if (m.name.empty()) return "-";
  if (m.statement) return m.value == 1 ? "yes" : "no";
  return number(m.value, 6) + (m.unit.empty() ? "" : " " + m.unit);
}

std::string line_of(const Change& change, bool colour) {
  const bool worse = change.verdict == Verdict::Worse;
  const Measured& known = change.after.name.empty() ? change.before : change.after;
  const bool both = !change.before.name.empty() && !change.after.name.empty();
  std::string line =
      fmt::format("{}{:<8}{}{}: {} -> {}", worse && colour ? "\033[1;31m" : "", to_string(change.verdict),
                  worse && colour ? "\033[0m" : "", known.name, shown(change.before), shown(change.after));
  if (both && !known.statement) {
    const std::string much = by_how_much(change.before.value, change.after.value);
    if (!much.empty()) line += " (" + much + ")";
  }
  if (!change.note.empty()) line += "; " + change.note;
  return line + "\n";
}

}  // namespace

std::string comparison_text(const std::vector<FileComparison>& comparison, bool all, bool colour) {
  const std::size_t most = all ? std::numeric_limits<std::size_t>::max() : 20;
  std::string text;
  std::size_t worse = 0, gone = 0;
  for (const FileComparison& file : comparison) {
    std::size_t shown_lines = 0, unjudged = 0, left_out = 0;
    for (const Change& change : file.changes) {
      const bool judged = change.judged;
      unjudged += !judged;
      if (shown_lines == most || (!judged && !all)) {
        left_out += judged;
        continue;
      }
      ++shown_lines;
      text += line_of(change, colour);
    }
    if (left_out > 0) text += fmt::format("         ... and {} more; --all lists them\n", left_out);
    text += fmt::format("{}: {} same", file.file, file.same);
    for (const Verdict v :
         {Verdict::Worse, Verdict::Better, Verdict::Changed, Verdict::New, Verdict::Missing})
      if (file.count(v) > 0) text += fmt::format(", {} {}", file.count(v), to_string(v));
    if (unjudged > 0)
      text += fmt::format(" ({} measured once: their noise is not known, so they are not judged)", unjudged);
    text += "\n\n";
    worse += file.count(Verdict::Worse);
    gone += file.count(Verdict::Missing);
  }
  if (worse + gone == 0) return text + "no regression beyond noise\n";
  return text + fmt::format("{} regressions{}\n", worse + gone,
                            gone > 0 ? fmt::format(", {} of them numbers that have gone", gone) : "");
}

}  // namespace reports
