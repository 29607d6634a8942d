#pragma once

#include <memory>

#include "solver/simulation.hpp"
#include "solver/sph/sph_scheme.hpp"

namespace mpm {

/// Smoothed particle hydrodynamics on a scene, as make_simulation() for the material point method. `threads`
/// work on it (0: default_threads()); the results are the same for any number of them. Throws SceneError for
/// scenes that cannot be simulated, seedings other than an even lattice, and for walls closer than the
/// kernel's reach.
std::unique_ptr<Simulation> make_sph_solver(const Scene& scene, const SphScheme& scheme, int threads = 0);

}  // namespace mpm
