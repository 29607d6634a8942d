#pragma once

#include <string>
#include <vector>

#include "reference/vortices/lid_driven_cavity.hpp"

namespace verification {

/// The published centre lines of a cavity of this project (verification/studies/cavity/).
struct CavityTable {
  std::vector<reference::CavityPoint> points;
  double largest_uncertainty = 0;  ///< U95 of the least certain of them [lid's velocity]
};

/// By a fluid's name in reference/cavity/benchmark_fluids.hpp, from the text that the build has put into the
/// program; null where there is none.
const CavityTable* cavity_table(const std::string& fluid);

}  // namespace verification
