#include <fmt/format.h>

#include <algorithm>

#include "reports/compare/compare.hpp"
#include "verification/commands/commands.hpp"
#include "verification/commands/output.hpp"
#include "verification/commands/terminal.hpp"

namespace verification {

int compare_command(const CompareOptions& options) {
  const auto comparison = reports::compare_results(options.before, options.after, {options.tolerance});
  say("{}", reports::comparison_text(comparison, options.all, use_colour()));
  return std::ranges::any_of(comparison, &reports::FileComparison::regressed) ? 1 : 0;
}

}  // namespace verification
