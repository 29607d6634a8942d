#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "solver/grid/stencil.hpp"
#include "solver/kernel/kernel.hpp"
#include "solver/particles.hpp"

namespace mpm {

/// Moves every particle by dt [s] with velocity(p) [m/s]; x in periodic directions wraps. The same loop finds
/// out whether the state can be continued from.
template <class Velocity>
Motion move_particles(const Grid& grid, Particles& particles, double dt, const Velocity& velocity) {
  Motion motion;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    Vec2& x_p = particles.position[p];
    x_p += dt * velocity(p);
    motion.inside &= grid.x.contain(x_p.x()) && grid.y.contain(x_p.y());
    motion.dense &= particles.density[p] > 0;
    motion.energy += particles.velocity[p].squaredNorm();
  }
  return motion;
}

/// Why a simulation ends after such a motion; none while it may go on.
inline std::optional<std::string> breakdown_of(const Motion& motion) {
  if (!std::isfinite(motion.energy)) return "velocity is not finite";
  if (!motion.inside) return "a particle left the domain";
  if (!motion.dense) return "density is not positive";
  return std::nullopt;
}

}  // namespace mpm
