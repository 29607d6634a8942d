#pragma once

#include <memory>

#include "solver/simulation.hpp"

namespace mpm {

/// Smoothed particle hydrodynamics on a scene. Throws SceneError for seedings other than an even lattice, and
/// for walls closer than the kernel's reach.
std::unique_ptr<Simulation> make_sph_solver(const Scene& scene, const SphScheme& scheme, int threads);

}  // namespace mpm
