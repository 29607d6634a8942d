#pragma once

#include <optional>
#include <string>

#include "verification/study/run_data.hpp"

namespace verification {

/// What a finished simulation left behind, as bytes of this machine: profile, history, shear, probe, number
/// of steps, status and wall time. What names the run (study, variant) is not among them, so that every study
/// with the same scene can use it.
std::string encode_run(const RunData& data);

/// The run that encode_run() wrote, taken over for a plan with the same scene; errors are left to be
/// measured. Nothing for bytes that are no such run.
std::optional<RunData> decode_run(const std::string& bytes, const Study& study, const PlannedRun& plan);

}  // namespace verification
