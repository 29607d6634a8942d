#pragma once

#include <string>
#include <vector>

#include "verification/runs/pilot/pilot_runs.hpp"

// dt = "auto": the largest step whose error in time stays a stated fraction of the error in space.
namespace verification {

/// What the pilot of one variant came to.
struct PilotOutcome {
  std::vector<reports::TimeStepRecord> steps;  ///< one a level; bound "none" where none could be chosen
  std::vector<reports::PilotRecord> runs;      ///< in the order in which they were made
  std::vector<reports::TimingRecord> timings;  ///< of those
};

/// Chooses the steps of a variant whose scenes say dt = "auto".
///
/// On the coarsest level it runs three steps, each half of the one before, from the longest that the limits
/// allow (where none bounds it: an eighth of the interval between outputs), and takes C_t and q of the error
/// in time C_t dt^q from their differences, the error in space from the finest less its error in time, field
/// by field (Richardson). It goes on to longer or shorter steps until the step that it would choose lies
/// among those that it ran, or a limit does not let it. One run on the second level, at the step that would
/// be chosen there, gives C_h and p of the error in space C_h h^p; with compare_with = "finest" that run is
/// what the first level is measured by, and p is theory's. Then dt = (fraction C_h h^p/C_t)^(1/q) on every
/// level, bounded by the limits of that level, as a whole part of the interval between outputs.
///
/// A run that diverges is recorded, and no longer step is chosen than one that stood. Where the error in time
/// is round-off, the limits alone bound the step. Where it has no order, a step will do whose halves change
/// the result by less than the fraction; if there is none, or no error in space, no step is chosen: the
/// records say so, and have the step that the limits give.
///
/// The result depends on nothing but the study and what `run` returns.
PilotOutcome choose_steps(const Study& study, const std::string& variant, const PilotRunner& run);

}  // namespace verification
