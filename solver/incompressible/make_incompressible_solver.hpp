#pragma once

#include <memory>

#include "solver/incompressible/incompressible_scheme.hpp"
#include "solver/incompressible/wall_shares.hpp"
#include "solver/simulation.hpp"

namespace mpm {

/// The incompressible method on a scene, as make_simulation() for the weakly compressible one. `threads` work
/// on it (0: default_threads()); the results are the same for any number of them. Throws SceneError for
/// scenes that cannot be simulated.
std::unique_ptr<Simulation> make_incompressible_solver(const Scene& scene, const IncompressibleScheme& scheme,
                                                       int threads = 0, const WallShares& shares = {});

/// Throws SceneError for what the incompressible method does not know: free surfaces, walls that move into
/// the fluid.
void require_incompressible_fits(const IncompressibleScheme& scheme, const Scene& scene);

}  // namespace mpm
