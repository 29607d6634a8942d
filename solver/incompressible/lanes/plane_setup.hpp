#pragma once

#include "solver/incompressible/lanes/plane_kernel.hpp"
#include "solver/incompressible/space/velocity_space.hpp"

namespace mpm::incompressible {

/// What the vector kernels read of a velocity space, which must outlive them; `regularisation` as in
/// IncompressibleScheme.
PlaneSetup plane_setup(const VelocitySpace& space, double regularisation);

}  // namespace mpm::incompressible
