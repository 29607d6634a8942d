#pragma once

#include "solver/grid/stencil.hpp"
#include "solver/particles.hpp"
#include "solver/scene/scene.hpp"

namespace mpm {

/// f_i += m_i b. Returns the force on the whole fluid per unit depth [N/m].
inline Vec2 add_body_forces(Grid& grid, const Vec2& b) {
  Vec2 total = Vec2::Zero();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Vec2 force = grid.mass[i] * b;
    grid.force[i] += force;
    total += force;
  }
  return total;
}

/// f_i += sum_p N_ip m_p b_p, b_p the particles' accelerations [m/s2]. Returns the force on the whole fluid.
template <class Basis>
Vec2 add_particle_forces(Grid& grid, const Particles& particles, const VectorField& b) {
  Vec2 total = Vec2::Zero();
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2 force = particles.mass[p] * b[p];
    total += force;
    Stencil<Basis>(grid, particles.position[p]).values([&](std::size_t i, double n) {
      grid.force[i] += n * force;
    });
  }
  return total;
}

/// f_i -= sum_p (m_p/rho_p) sigma_p grad N_ip (paper Eq. 17).
template <class Basis>
void add_stress_forces(Grid& grid, const Particles& particles) {
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Mat2 volume_stress = (particles.mass[p] / particles.density[p]) * particles.stress[p];
    Stencil<Basis>(grid, particles.position[p]).gradients([&](std::size_t i, const Vec2& dn) {
      grid.force[i] -= volume_stress * dn;
    });
  }
}

}  // namespace mpm
