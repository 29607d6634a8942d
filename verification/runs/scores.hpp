#pragma once

#include "verification/runs/run_data.hpp"

namespace verification {

/// Energy of the particles over that of the exact solution at a time: the sum of squared velocities over the
/// particles over the same sum of the exact ones at the same places. NaN without samples, or where the exact
/// solution is at rest.
double energy_ratio(const RunData& run, double t);

/// When a run went wrong [s]: the first time of its history at which the root mean square velocity of the
/// particles exceeded Scoreboard::blown_up, or that of its breakdown if that came first; NaN for a run that
/// did neither.
double time_of_divergence(const RunData& run);

/// What became of one scheme, judged against its study's expectation: a row of scoreboard.csv.
reports::ScoreRecord score_of(const RunData& run, const Study& study);

/// The rows of a study that is a hard case; none for others.
std::vector<reports::ScoreRecord> score_records(const StudyData& data);

}  // namespace verification
