#include <fmt/format.h>

#include "reports/pages/report.hpp"
#include "verification/commands/commands.hpp"
#include "verification/commands/output.hpp"
#include "verification/flows/reference_store.hpp"

namespace verification {

int report_command(const ReportCommandOptions& options) {
  const reports::ReportOutcome outcome =
      reports::write_report(options.dir, {cache_directory(), job_count(0), options.pdf});
  for (const std::string& warning : outcome.warnings) warn("warning: {}\n", warning);
  say("{}: {} of {} checks pass; see {}\n", outcome.passed ? "PASS" : "FAIL", outcome.checks_passed,
      outcome.checks_passed + outcome.checks_failed, (options.dir / "report.html").string());
  return outcome.passed ? 0 : 1;
}

}  // namespace verification
