#include "solver/incompressible/make_incompressible_solver.hpp"

#include "solver/incompressible/incompressible_solver.hpp"
#include "solver/kernel/isa.hpp"

namespace mpm {
void require_incompressible_fits(const IncompressibleScheme& scheme, const Scene& scene) {
  scheme.validate();
  if (scene.free_surface) throw SceneError("an incompressible fluid fills its box: no fluid_region");
  for (const int axis : {0, 1}) {
    if (scene.periodic(axis)) continue;
    for (const int end : {0, 1})
      if (scene.sides[static_cast<std::size_t>(2 * axis + end)].velocity(scene.start)[axis] != 0)
        throw SceneError("a wall of an incompressible fluid moves along itself only");
  }
}

std::unique_ptr<Simulation> make_incompressible_solver(const Scene& scene, const IncompressibleScheme& scheme,
                                                       int threads, const WallShares& shares) {
  scene.validate();
  require_incompressible_fits(scheme, scene);
  if (threads == 0) threads = default_threads();
  return std::make_unique<incompressible::IncompressibleSolver>(scene, scheme, threads, shares);
}

}  // namespace mpm
