#pragma once

#include <vector>

#include "verification/checks/quantities.hpp"

namespace verification {

/// Adds what is asked of a fluid with a free surface.
void add_surface_quantities(std::vector<QuantityEntry>& entries);

}  // namespace verification
