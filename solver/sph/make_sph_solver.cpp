#include "solver/sph/make_sph_solver.hpp"

#include "solver/kernel/isa.hpp"
#include "solver/sph/sph_solver.hpp"
#include "solver/sph/stable_sph_step.hpp"

namespace mpm {

std::unique_ptr<Simulation> make_sph_solver(const Scene& scene, const SphScheme& scheme, int threads) {
  scene.validate();
  scheme.validate();
  if (threads == 0) threads = default_threads();
  for (const Seeding::Rule rule : scene.seeding.rule)
    if (rule != Seeding::Rule::Even)
      throw SceneError("SPH takes particles of equal mass: seeding must be even");
  require_sph_fits(scheme, scene);
  return std::make_unique<sph::SphSolver>(scene, scheme, threads);
}

}  // namespace mpm
