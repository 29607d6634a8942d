#pragma once

#include <filesystem>
#include <vector>

#include "verification/runs/run_data.hpp"

namespace verification {

/// Reads what somebody else's solver left in a directory into the records of a run, and judges whether it is
/// whole: profile.csv, and history.csv, shear.csv and state.csv where its study says so; lines that begin
/// with # are skipped. The study's exact solution is laid beside. Copies that the reader needs go into
/// `scratch`. Throws std::runtime_error that says what is missing, found and expected.
void read_delivery(const Study& study, const PlannedRun& plan, const std::filesystem::path& folder,
                   const std::filesystem::path& scratch, RunData& data);

/// What it says of itself in run.json, where there is one: name (unless the study gives one), version, steps,
/// particles, cells, dt, wall_s. Throws std::runtime_error where its status is a failure, or nothing that can
/// be read.
void read_run_json(const std::filesystem::path& file, const ForeignSolver& solver, RunData& data);

/// The locations that a profile.csv holds, grid first; empty where it cannot be read.
std::vector<Location> locations_in(const std::filesystem::path& profile);

}  // namespace verification
