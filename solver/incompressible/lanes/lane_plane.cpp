// Compiled once for every instruction set, see CMakeLists.txt.
#include "solver/incompressible/lanes/lane_plane.hpp"

namespace mpm::MPM_ISA {

std::unique_ptr<PlaneKernel> make_plane_kernel(const PlaneSetup& setup) {
  switch (setup.degree) {
    case 2:
      return std::make_unique<LanePlane<2>>(setup);
    case 3:
      return std::make_unique<LanePlane<3>>(setup);
    default:
      return std::make_unique<LanePlane<4>>(setup);
  }
}

}  // namespace mpm::MPM_ISA
