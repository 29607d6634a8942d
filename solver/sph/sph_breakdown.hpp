#pragma once

#include <optional>
#include <string>

#include "solver/particles.hpp"
#include "solver/scene/scene.hpp"

namespace mpm::sph {

/// Why particles can move no further, if so: velocities that are not finite [m/s], a density that is not
/// positive [kg/m3], a place outside the walls, or a step in which one moved `longest_move` [m], further than
/// the box is long: no list of neighbours can be made of such places.
std::optional<std::string> breakdown_of(const Scene& scene, const VectorField& position,
                                        const VectorField& velocity, const ScalarField& density,
                                        double longest_move);

}  // namespace mpm::sph
