#pragma once

#include <functional>

#include "solver/scene/scene.hpp"

namespace verification {

using mpm::Vec2;

/// A layer of fluid at rest under gravity with a free surface, as particles in cells.
struct ColumnAtRest {
  double surface = 0;     ///< height of the fluid over the bottom of the box [m]
  double gravity = 0;     ///< towards the bottom [m/s2]
  double cell_size = 0;   ///< along y [m]
  int rows_per_cell = 2;  ///< of particles, evenly spaced
};

/// The density [kg/m3] at a place for which the linear basis with one density a cell is in equilibrium to
/// round-off: at every node the difference of the pressures beside it carries the mass that it holds, from
/// the surface down. The hydrostatic density of the fluid itself differs by O(h^2), which sets it swinging.
std::function<double(const Vec2&)> density_at_rest(const ColumnAtRest& column, const mpm::Fluid& fluid);

}  // namespace verification
