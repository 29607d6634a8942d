#pragma once

#include <optional>
#include <string>

#include "verification/runs/run_data.hpp"

namespace verification {

/// What a finished simulation left behind, as bytes of this machine: profile, history, shear, probe, number
/// of steps, status and wall time. What names the run (study, variant) is not among them, so that every study
/// with the same scene can use it.
std::string encode_run(const RunData& data);

/// The run that encode_run() wrote, taken over for a plan with the same scene; errors are left to be
/// measured. Nothing for bytes that are no such run.
std::optional<RunData> decode_run(const std::string& bytes, const Study& study, const PlannedRun& plan);

/// What a case of a [stability] came to, and the time that it took.
struct MeasuredLimits {
  std::vector<reports::StabilityRecord> records;
  double wall_s = 0;  ///< [s]
};

/// The same for limits of stability: the study's name is not among the bytes.
std::string encode_limits(const MeasuredLimits& limits);
std::optional<MeasuredLimits> decode_limits(const std::string& bytes, const std::string& study);

}  // namespace verification
