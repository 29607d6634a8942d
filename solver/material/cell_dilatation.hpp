#pragma once

#include <algorithm>
#include <vector>

#include "solver/grid/stencil.hpp"
#include "solver/material/pressure.hpp"
#include "solver/particles.hpp"

namespace mpm {

// One dilatation and one density a cell. A particle that integrates the divergence at its own place gathers,
// where the flow mixes particles, a density that has nothing to do with how many there are around it, and
// nothing pulls it back. Here the volume V_c of a cell's particles, sum_p m_p/rho_p, grows with the
// divergence at the centre of the cell, and all of them take the density that is left, sum_p m_p/V_c. What
// particles bring along when they change cells is mixed, and volume is kept.
//
// The trace of their strain rate is that of the centre, too, and the mean stress acts with the gradients at
// the centre, f_i = -sum_c V_c s_c grad N_i(x_c): the transpose of the divergence, so that pressure gives the
// flow exactly the work that it takes from it. With gradients at the particles instead the noise of their
// places drives the flow, and a lid-driven cavity breaks down within five lid lengths.

/// The densities of a grid's cells.
template <class Basis>
class CellDensities {
 public:
  /// The density of every cell with particles after the volume ratio ratio(L) of the velocity gradient L at
  /// its centre [1/s].
  template <class Ratio>
  void assign(const CellTaitPressure& pressure, const Particles& particles, const Grid& grid,
              const VectorField& nodal_velocity, const Ratio& ratio) {
    const auto cells = static_cast<std::size_t>(grid.x.cells) * static_cast<std::size_t>(grid.y.cells);
    mass_.assign(cells, 0);
    volume_.assign(cells, 0);
    cell_.resize(particles.size());
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec2& x = particles.position[p];
      const std::size_t c = cell_[p] =
          static_cast<std::size_t>(grid.y.cell_of(x.y()) * grid.x.cells + grid.x.cell_of(x.x()));
      mass_[c] += particles.mass[p];
      volume_[c] += particles.mass[p] / particles.density[p];
    }
    density_.assign(cells, 0);
    dilatation_.assign(cells, 0);
    for (int j = 0; j < grid.y.cells; ++j)
      for (int i = 0; i < grid.x.cells; ++i) {
        const auto c = static_cast<std::size_t>(j * grid.x.cells + i);
        if (!(mass_[c] > 0)) continue;
        const Mat2 l =
            gradient<Basis>(grid, nodal_velocity, Vec2((i + 0.5) * grid.x.h, (j + 0.5) * grid.y.h));
        dilatation_[c] = l.trace();
        density_[c] = mass_[c] / (volume_[c] * ratio(l));
        if (density_[c] > 0 && density_[c] < pressure.least_density) density_[c] = pressure.least_density;
      }
  }

  /// Of the cell in which a particle is [kg/m3].
  [[nodiscard]] double of(std::size_t particle) const { return density_[cell_[particle]]; }
  /// Divergence at its centre [1/s].
  [[nodiscard]] double dilatation(std::size_t particle) const { return dilatation_[cell_[particle]]; }

 private:
  ScalarField mass_, volume_, density_, dilatation_;  // by cell
  std::vector<std::size_t> cell_;                     // of every particle
};

}  // namespace mpm
