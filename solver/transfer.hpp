#pragma once

#include "solver/linear_algebra.hpp"

namespace mpm {

// Transfer policies: how a particle's velocity follows the grid.

/// FLIP: the particle keeps its velocity and takes the grid's increment (paper Eqs. 18-19).
struct Flip {
  static Vec2 update(const Vec2& particle_velocity, const Vec2& grid_increment) {
    return particle_velocity + grid_increment;
  }
};

}  // namespace mpm
