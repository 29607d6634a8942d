#pragma once

#include <vector>

#include "verification/runs/run_data.hpp"

namespace verification {

/// The tables of a suite from its studies, in their order; claims in the order of the paper.
reports::Results collect(const std::vector<const StudyData*>& studies);

}  // namespace verification
