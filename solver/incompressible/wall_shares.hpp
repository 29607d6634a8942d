#pragma once

#include <array>
#include <functional>

namespace mpm {

/// Shares of its velocity with which each wall (indexed by Edge) moves at a coordinate along it [m]; an empty
/// one stands for 1 everywhere. The incompressible method alone takes walls whose velocity varies along them.
using WallShares = std::array<std::function<double(double)>, 4>;

}  // namespace mpm
