#include "solver/simulation.hpp"

#include "solver/solver.hpp"

namespace mpm {

VectorField cell_corners(const Scene& scene) {
  const Grid grid(scene, LinearBasis::degree);
  VectorField corners;
  for (int j = 0; j < grid.y.corners(); ++j)
    for (int i = 0; i < grid.x.corners(); ++i) corners.emplace_back(grid.x.corner(i), grid.y.corner(j));
  return corners;
}

std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Scheme& scheme) {
  scene.validate();
  return std::make_unique<Solver<LinearBasis, Flip>>(scene, scheme.stepping);
}

}  // namespace mpm
