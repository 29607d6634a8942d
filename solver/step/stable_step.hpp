#pragma once

#include "solver/scene/scene.hpp"
#include "solver/scene/scheme.hpp"

namespace mpm {

/// Largest stable explicit step of plane flow with the whole stress, in units of the cell.
struct StableStep {
  double viscous;   ///< nu dt/h^2, without sound; infinite for implicit viscosity
  double acoustic;  ///< c dt/h, without viscosity
};

/// Limits of a scheme wherever the particles of a regular lattice stand in their cells, for every wave, away
/// from walls. `particles_per_cell` counts along one axis; from two on the limits grow, so that those of two
/// (at Gauss points, which is worse than evenly) hold. Zero: no step is stable. They are computed from
/// amplification matrices and confirmed on the solver in verification/stability; a test there compares.
StableStep stable_step(const Scheme& scheme, int particles_per_cell);

/// Fewest particles a cell along the axes in which the scene can vary.
int fewest_particles_per_cell(const Scene& scene);

}  // namespace mpm
