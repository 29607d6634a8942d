#pragma once

#include <filesystem>
#include <vector>

#include "verification/runs/run_data.hpp"
#include "verification/suite/shown_failures.hpp"

namespace verification {

/// What became of a negative control.
struct ControlOutcome {
  reports::ControlRecord record;
  std::vector<reports::CheckRecord> checks;  ///< study.control->expected_checks() of them
  double wall_s = 0;
};

/// Judges a study with a [control] by a program of its own, as `mpm-verify run FILE --plain` would, into
/// out/controls/NAME, and compares what it leaves (exit code, console, tables, JUnit, Markdown, page) with
/// what the control demands. Nothing of it comes from a cache. Throws Interrupted, and reports::IoError where
/// `out` cannot be written.
ControlOutcome run_control(const Study& study, const std::filesystem::path& out);

/// The same of what is there: how the program ended (NaN: not by itself), its tables, and what its pages
/// show. `trouble` joins every reason.
ControlOutcome judged_control(const Study& study, double exit_code, const reports::Results& results,
                              const std::vector<Shown>& shown, const std::string& trouble);

}  // namespace verification
