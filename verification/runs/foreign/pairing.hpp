#pragma once

#include <vector>

#include "reports/records/records.hpp"
#include "verification/study/study.hpp"

namespace verification {

/// How far apart two rows of somebody's files may lie and still mean the same point [m]: rounding of text on
/// a grid; a quarter of the spacing for particles, which every time step moves a little differently.
double pairing_distance(const SceneConfig& scene, Location location);

/// The rows of `others` in the order of their counterparts in `rows`, whatever order they came in: each the
/// one other row within `distance` of it. Empty where any row has none, two rows share one, or the numbers
/// differ.
std::vector<const reports::ProfileRow*> paired_by_place(const std::vector<const reports::ProfileRow*>& rows,
                                                        const std::vector<const reports::ProfileRow*>& others,
                                                        double distance);

}  // namespace verification
