#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/incompressible/lanes/plane_kernel.hpp"
#include "solver/incompressible/lanes/site_kernel.hpp"
#include "solver/kernel/dense_product.hpp"
#include "solver/kernel/full_mass/full_mass_kernel.hpp"
#include "solver/kernel/kernel.hpp"
#include "solver/sph/pairs/pair_loops.hpp"

namespace mpm {

/// Instruction sets that the kernel was compiled for and this machine has, by name, the plainest first:
/// "baseline" (the compiler's default), and on x86-64 "avx2" and "avx512" (the levels v3 and v4 of its ABI).
std::vector<std::string> available_isas();

/// The one in use: the last of available_isas(), unless MPM_ISA in the environment or use_isa() names
/// another.
std::string current_isa();

/// From now on simulations start on this one. Throws SceneError, which lists the available ones, for others.
void use_isa(const std::string& name);

/// Threads of one simulation, for those that are not told (make_simulation): 1, until use_threads() says
/// otherwise. Results do not depend on it.
int default_threads();
void use_threads(int threads);

/// Kernels of the current instruction set.
std::unique_ptr<Kernel> make_kernel(const KernelSetup& setup);
std::unique_ptr<FullMassKernel> make_full_mass_kernel(const FullMassSetup& setup);
std::unique_ptr<PlaneKernel> make_plane_kernel(const PlaneSetup& setup);
std::unique_ptr<SiteKernel> make_site_kernel(const SiteSetup& setup);
FlowCurve flow_curve();
DenseProduct dense_product();
namespace sph {
PairLoops pair_loops();
}

}  // namespace mpm
