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

/// f_i -= sum_p (m_p/rho_p) sigma_p grad N_ip (paper Eq. 17), with the stencil_of(p).
template <class StencilOf>
void add_stress_forces(Grid& grid, const Particles& particles, const StencilOf& stencil_of) {
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Mat2 volume_stress = (particles.mass[p] / particles.density[p]) * particles.stress[p];
    stencil_of(p).gradients([&](std::size_t i, const Vec2& dn) { grid.force[i] -= volume_stress * dn; });
  }
}

/// The same with the mean stress at the centres of the cells, the sums over their particles in `tension`
/// (solver/material/cell_dilatation.hpp).
template <class Basis>
void add_cell_stress_forces(Grid& grid, const Particles& particles, ScalarField& tension) {
  tension.assign(static_cast<std::size_t>(grid.x.cells) * static_cast<std::size_t>(grid.y.cells), 0);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2& x = particles.position[p];
    const Mat2 volume_stress = (particles.mass[p] / particles.density[p]) * particles.stress[p];
    const double mean = 0.5 * volume_stress.trace();
    tension[static_cast<std::size_t>(grid.y.cell_of(x.y()) * grid.x.cells + grid.x.cell_of(x.x()))] += mean;
    const Mat2 deviator = volume_stress - mean * Mat2::Identity();
    Stencil<Basis>(grid, x).gradients([&](std::size_t i, const Vec2& dn) { grid.force[i] -= deviator * dn; });
  }
  for (int j = 0; j < grid.y.cells; ++j)
    for (int i = 0; i < grid.x.cells; ++i) {
      const double mean = tension[static_cast<std::size_t>(j * grid.x.cells + i)];
      if (mean == 0) continue;
      Stencil<Basis>(grid, Vec2((i + 0.5) * grid.x.h, (j + 0.5) * grid.y.h))
          .gradients([&](std::size_t node, const Vec2& dn) { grid.force[node] -= mean * dn; });
    }
}

/// Nodes lighter than `least` [kg/m] feel the other forces than m_i b in proportion to their mass.
inline void relieve_light_nodes(Grid& grid, const Vec2& b, double least) {
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double m = grid.mass[i];
    if (m < least) grid.force[i] = m * b + (m / least) * (grid.force[i] - m * b);
  }
}

}  // namespace mpm
