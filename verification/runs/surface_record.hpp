#pragma once

#include "reports/records/surface.hpp"
#include "solver/simulation.hpp"
#include "verification/scene/scene_config.hpp"

namespace verification {

/// How far the particles reach at time t [s], to the edge of what a particle fills at the start, and their
/// energies. Elastic energy of the Tait fluid, integral of P drho/rho^2 a mass: K/rho0 [(r^6 - 1)/6 + 1/r -
/// 1] with r = rho/rho0.
reports::SurfaceRow surface_at(const SceneConfig& scene, const mpm::Simulation& simulation, double t);

}  // namespace verification
