#include "solver/sph/make_sph_solver.hpp"

#include <variant>

#include "solver/kernel/isa.hpp"
#include "solver/material/pressure.hpp"
#include "solver/sph/sph_solver.hpp"

namespace mpm {

std::unique_ptr<Simulation> make_sph_solver(const Scene& scene, const SphScheme& scheme, int threads) {
  scene.validate();
  scheme.validate();
  if (threads == 0) threads = default_threads();
  for (const Seeding::Rule rule : scene.seeding.rule)
    if (rule != Seeding::Rule::Even)
      throw SceneError("SPH takes particles of equal mass: seeding must be even");
  require_sph_fits(scheme, scene);
  return std::visit(
      [&]<class Law>(const Law& law) -> std::unique_ptr<Simulation> {
        if (scene.fluid.pressure)
          return std::make_unique<sph::SphSolver<Law, TaitPressure>>(
              scene, scheme, law, TaitPressure{scene.fluid.bulk_modulus, 1 / scene.fluid.density}, threads);
        return std::make_unique<sph::SphSolver<Law, NoPressure>>(scene, scheme, law, NoPressure{}, threads);
      },
      scene.fluid.rheology);
}

}  // namespace mpm
