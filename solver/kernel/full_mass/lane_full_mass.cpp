// Compiled once for every instruction set, see CMakeLists.txt.
#include "solver/kernel/full_mass/lane_full_mass.hpp"

namespace mpm::MPM_ISA {

std::unique_ptr<FullMassKernel> make_full_mass_kernel(const FullMassSetup& setup) {
  switch (setup.particles.degree) {
    case 1:
      return std::make_unique<LaneFullMass<1>>(setup);
    case 2:
      return std::make_unique<LaneFullMass<2>>(setup);
    default:
      return std::make_unique<LaneFullMass<3>>(setup);
  }
}

}  // namespace mpm::MPM_ISA
