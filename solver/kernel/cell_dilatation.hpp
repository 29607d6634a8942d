#pragma once

#include <span>

#include "solver/kernel/cell_field.hpp"
#include "solver/kernel/cell_sums.hpp"

namespace mpm::MPM_ISA {

// One density a cell (solver/material/cell_dilatation.hpp). A cell is a lane, so nothing is exchanged.

template <class Basis>
CellWeights<Basis> centre_of_cells(const Basis& basis, const Block& block) {
  const Lanes middle[2] = {0.5, 0.5};
  return CellWeights<Basis>(basis, block, middle);
}

/// Of the cells of a block: divergence at their centres [1/s] and density after dt [kg/m3].
struct CellStrain {
  Lanes dilatation, density;
};

/// Their particles' mass over their volume, which grows with the divergence at the centre; the particles take
/// it, unless dt = 0.
template <class Basis>
CellStrain strain_cells(const Basis& basis, const Block& block, std::span<Slot> slots,
                        const CellVelocityGradient<Basis>& grad_v, double dt,
                        const CellTaitPressure& pressure, Lanes& least_volume) {
  Lanes mass = 0, volume = 0;
  for (const Slot& p : slots) {
    mass += p.mass;
    volume += p.volume;
  }
  const CellWeights<Basis> centre = centre_of_cells(basis, block);
  const Lanes dilatation = grad_v[0].at(centre).d_0 + grad_v[1].at(centre).d_1;
  volume = volume * (1 + dt * dilatation);
  least_volume = least(least_volume, volume);
  const Lanes density = at_least(mass / select(mass > 0, volume, 1), pressure.least_density);
  if (dt > 0)
    for (Slot& p : slots) p.volume = p.mass / select(p.mass > 0, density, 1);
  return {dilatation, density};
}

/// What the stress of a block's particles gives to the nodes of their cells. With a pressure of cells the
/// mean stress acts at their centres.
template <class Basis, class Pressure>
struct CellForces {
  DivergenceSums<Basis>& sums;
  Lanes tension = 0;

  template <class Weights>
  void add(const Weights& n_p, Stress stress) {
    if constexpr (Pressure::is_of_cell) {
      const Lanes mean = 0.5 * (stress.s_00 + stress.s_11);
      tension += mean;
      stress.s_00 -= mean;
      stress.s_11 -= mean;
    }
    sums.add(n_p, stress);
  }
  void finish(const Basis& basis, const Block& block) {
    if constexpr (Pressure::is_of_cell) sums.add(centre_of_cells(basis, block), {tension, tension, 0});
  }
};

}  // namespace mpm::MPM_ISA
