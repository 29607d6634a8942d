#include "solver/kernel/isa.hpp"

#include <atomic>
#include <cstdlib>
#include <mutex>

#include "solver/scene/scene.hpp"

namespace mpm {

namespace baseline {
std::unique_ptr<Kernel> make_kernel(const KernelSetup& setup);
std::unique_ptr<FullMassKernel> make_full_mass_kernel(const FullMassSetup& setup);
std::unique_ptr<PlaneKernel> make_plane_kernel(const PlaneSetup& setup);
std::unique_ptr<SiteKernel> make_site_kernel(const SiteSetup& setup);
void flow_curve(const Rheology& fluid, int count, const double* gdot_squared, double* viscosity);
void dense_product(int rows, int inner, int columns, const double* a, const double* b, double* c);
sph::PairLoops pair_loops();
}  // namespace baseline
#ifdef MPM_KERNEL_AVX2
namespace avx2 {
std::unique_ptr<Kernel> make_kernel(const KernelSetup& setup);
std::unique_ptr<FullMassKernel> make_full_mass_kernel(const FullMassSetup& setup);
std::unique_ptr<PlaneKernel> make_plane_kernel(const PlaneSetup& setup);
std::unique_ptr<SiteKernel> make_site_kernel(const SiteSetup& setup);
void flow_curve(const Rheology& fluid, int count, const double* gdot_squared, double* viscosity);
void dense_product(int rows, int inner, int columns, const double* a, const double* b, double* c);
sph::PairLoops pair_loops();
}  // namespace avx2
#endif
#ifdef MPM_KERNEL_AVX512
namespace avx512 {
std::unique_ptr<Kernel> make_kernel(const KernelSetup& setup);
std::unique_ptr<FullMassKernel> make_full_mass_kernel(const FullMassSetup& setup);
std::unique_ptr<PlaneKernel> make_plane_kernel(const PlaneSetup& setup);
std::unique_ptr<SiteKernel> make_site_kernel(const SiteSetup& setup);
void flow_curve(const Rheology& fluid, int count, const double* gdot_squared, double* viscosity);
void dense_product(int rows, int inner, int columns, const double* a, const double* b, double* c);
sph::PairLoops pair_loops();
}  // namespace avx512
#endif

namespace {

struct Isa {
  std::string name;
  std::unique_ptr<Kernel> (*make)(const KernelSetup&);
  std::unique_ptr<FullMassKernel> (*make_full_mass)(const FullMassSetup&);
  std::unique_ptr<PlaneKernel> (*make_plane)(const PlaneSetup&);
  std::unique_ptr<SiteKernel> (*make_sites)(const SiteSetup&);
  FlowCurve curve;
  DenseProduct multiply;
  sph::PairLoops (*loops)();
};

std::vector<Isa> isas() {
  std::vector<Isa> found{{"baseline", baseline::make_kernel, baseline::make_full_mass_kernel,
                          baseline::make_plane_kernel, baseline::make_site_kernel, baseline::flow_curve,
                          baseline::dense_product, baseline::pair_loops}};
#ifdef MPM_KERNEL_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    found.push_back({"avx2", avx2::make_kernel, avx2::make_full_mass_kernel, avx2::make_plane_kernel,
                     avx2::make_site_kernel, avx2::flow_curve, avx2::dense_product, avx2::pair_loops});
#endif
#ifdef MPM_KERNEL_AVX512
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    found.push_back({"avx512", avx512::make_kernel, avx512::make_full_mass_kernel, avx512::make_plane_kernel,
                     avx512::make_site_kernel, avx512::flow_curve, avx512::dense_product,
                     avx512::pair_loops});
#endif
  return found;
}

Isa isa_named(const std::string& name) {
  std::string known;
  for (const Isa& isa : isas()) {
    if (isa.name == name) return isa;
    known += (known.empty() ? "" : ", ") + isa.name;
  }
  throw SceneError("instruction set '" + name +
                   "' (--isa or MPM_ISA) is not available; choose one of: " + known);
}

/// The choice, and what guards it: runs start on several threads.
struct Choice {
  std::mutex mutex;
  std::string name;
};
Choice& choice() {
  static Choice the_choice;
  return the_choice;
}

std::atomic<int> threads_of_one_simulation = 1;

Isa current() {
  const std::scoped_lock lock(choice().mutex);
  if (!choice().name.empty()) return isa_named(choice().name);
  const char* asked = std::getenv("MPM_ISA");
  return asked && *asked ? isa_named(asked) : isas().back();
}

}  // namespace

std::vector<std::string> available_isas() {
  std::vector<std::string> names;
  for (const Isa& isa : isas()) names.push_back(isa.name);
  return names;
}

std::string current_isa() {
  return current().name;
}

void use_isa(const std::string& name) {
  const Isa isa = isa_named(name);
  const std::scoped_lock lock(choice().mutex);
  choice().name = isa.name;
}

int default_threads() {
  return threads_of_one_simulation;
}

void use_threads(int threads) {
  if (threads < 1) throw SceneError("the number of threads must be at least 1");
  threads_of_one_simulation = threads;
}

std::unique_ptr<Kernel> make_kernel(const KernelSetup& setup) {
  return current().make(setup);
}

std::unique_ptr<FullMassKernel> make_full_mass_kernel(const FullMassSetup& setup) {
  return current().make_full_mass(setup);
}

std::unique_ptr<PlaneKernel> make_plane_kernel(const PlaneSetup& setup) {
  return current().make_plane(setup);
}

std::unique_ptr<SiteKernel> make_site_kernel(const SiteSetup& setup) {
  return current().make_sites(setup);
}

FlowCurve flow_curve() {
  return current().curve;
}

DenseProduct dense_product() {
  return current().multiply;
}

sph::PairLoops sph::pair_loops() {
  return current().loops();
}

}  // namespace mpm
