#pragma once

#include <filesystem>
#include <vector>

#include "verification/runs/run_data.hpp"

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

}  // namespace verification
