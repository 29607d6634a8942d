#pragma once

#include <string>
#include <vector>

#include "reports/records/records.hpp"
#include "verification/study/study.hpp"

namespace verification {

/// What a foreign profile lacks to be judged; empty for one that is whole. At every output time and location:
/// as many points as cells across (or the study's own number), no gap wider than two cells across the flow
/// nor, where there is more than one cell, along it, no place twice, none outside the domain, no value that
/// is not finite; and no row of another time or location. Each shortcoming is one sentence.
std::vector<std::string> shortcomings(const std::vector<reports::ProfileRow>& rows, const PlannedRun& plan,
                                      const ForeignSolver& solver);

/// The output time that a foreign file means: the nearest, within 1e-6 of the spacing of outputs; NaN for a
/// time nobody asked for.
double output_time(const SceneConfig& scene, double t);

}  // namespace verification
