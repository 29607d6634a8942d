#pragma once

#include "verification/convergence/norms.hpp"
#include "verification/runs/run_data.hpp"

namespace verification {

/// Relative error norms of a run at every output time on grid and particles, from its profile rows. An output
/// that was not reached, and a run without an exact solution, give NaN.
std::vector<reports::ErrorRecord> measure_errors(const RunData& run);

/// Of a study that compares with its own finest level (Comparison::Finest): the errors of all other levels
/// against that level's grid, interpolated; the finest has none.
void compare_with_finest(StudyData& data);

/// Fills levels and orders of a study with a ladder: against the exact solution in space and Mach number,
/// from successive differences on one mesh in time. Orders in space carry the GCI and the Eca-Hoekstra
/// uncertainty of the probe velocity.
void measure_orders(StudyData& data);

/// Relative norms of the difference of two runs on the same mesh, particle by particle and corner by corner;
/// NaN where one has not come to that time. Our own rows keep their order; those of others are paired by
/// place.
Norms difference_norms(const RunData& a, const RunData& b, double t, Location location);

/// Relative norms of the difference of a run to a finer one of its ladder, whose grid is interpolated; NaN
/// where that is none.
Norms norms_against(const RunData& run, const RunData& finer, double t, Location location);

/// The value of one norm.
double pick(const reports::ErrorRecord& error, const std::string& norm);

/// Profile rows of one time and location, in the order in which they were taken.
std::vector<const reports::ProfileRow*> rows_at(const RunData& run, double t, Location location);

}  // namespace verification
