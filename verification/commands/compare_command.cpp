#include <fmt/format.h>

#include <algorithm>

#include "reports/compare/compare.hpp"
#include "verification/commands/commands.hpp"
#include "verification/commands/terminal.hpp"

namespace verification {

int compare_command(const CompareOptions& options) {
  const auto comparison = reports::compare_results(options.before, options.after, {options.tolerance});
  fmt::print("{}", reports::comparison_text(comparison, options.all, use_colour()));
  const bool worse = std::ranges::any_of(
      comparison, [](const auto& file) { return file.count(reports::Verdict::Worse) > 0; });
  return worse ? 1 : 0;
}

}  // namespace verification
