#include <fmt/format.h>

#include "reports/pages/report.hpp"
#include "verification/commands/commands.hpp"
#include "verification/commands/output.hpp"
#include "verification/flows/reference_store.hpp"

namespace verification {

int report_command(const std::filesystem::path& dir) {
  const reports::ReportOutcome outcome = reports::write_report(dir, {cache_directory(), job_count(0)});
  for (const std::string& warning : outcome.warnings) warn("warning: {}\n", warning);
  say("{}: {} of {} checks pass; see {}\n", outcome.passed ? "PASS" : "FAIL", outcome.checks_passed,
      outcome.checks_passed + outcome.checks_failed, (dir / "report.html").string());
  return outcome.passed ? 0 : 1;
}

}  // namespace verification
