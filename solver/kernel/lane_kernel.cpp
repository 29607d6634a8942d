// Compiled once for every instruction set, see CMakeLists.txt.
#include "solver/kernel/lane_kernel.hpp"

namespace mpm::MPM_ISA {

template <int degree>
std::unique_ptr<Kernel> make_kernel_of_degree(const KernelSetup& setup) {
  if (setup.strip) return std::make_unique<LaneKernel<LaneBasis<degree, true>>>(setup);
  return std::make_unique<LaneKernel<LaneBasis<degree, false>>>(setup);
}

std::unique_ptr<Kernel> make_kernel(const KernelSetup& setup) {
  switch (setup.degree) {
    case 1:
      return make_kernel_of_degree<1>(setup);
    case 2:
      return make_kernel_of_degree<2>(setup);
    default:
      return make_kernel_of_degree<3>(setup);
  }
}

}  // namespace mpm::MPM_ISA
