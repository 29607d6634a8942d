#pragma once

#include "solver/particles.hpp"
#include "solver/scene.hpp"

namespace mpm {

/// Particles evenly spaced in every cell ((i + 1/2)/n of the cell along each direction), at reference density
/// and with the scene's initial velocity. Row by row from the bottom, left to right: the order fixes every
/// sum.
Particles seed_particles(const Scene& scene);

}  // namespace mpm
