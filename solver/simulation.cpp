#include "solver/simulation.hpp"

#include "solver/grid.hpp"
#include "solver/make_solver.hpp"

namespace mpm {

VectorField cell_corners(const Scene& scene) {
  const Grid grid(scene, 1);
  VectorField corners;
  for (int j = 0; j < grid.y.corners(); ++j)
    for (int i = 0; i < grid.x.corners(); ++i) corners.emplace_back(grid.x.corner(i), grid.y.corner(j));
  return corners;
}

std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Scheme& scheme) {
  scene.validate();
  scheme.validate();
  switch (scheme.basis) {
    case Scheme::Basis::Linear:
      return make_linear_solver(scene, scheme);
    case Scheme::Basis::Quadratic:
      return make_quadratic_solver(scene, scheme);
    case Scheme::Basis::Cubic:
      return make_cubic_solver(scene, scheme);
  }
  throw SceneError("a basis has no solver");
}

}  // namespace mpm
