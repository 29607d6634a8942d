#include "solver/simulation.hpp"

#include "solver/grid/axis.hpp"
#include "solver/kernel/isa.hpp"
#include "solver/table/make_solver.hpp"

namespace mpm {

namespace {

/// Corners of cells cut into `parts` along each direction.
VectorField lattice(const Scene& scene, std::array<int, 2> parts) {
  const Axis x(scene.size.x(), scene.cells[0] * parts[0], scene.periodic(0), 1);
  const Axis y(scene.size.y(), scene.cells[1] * parts[1], scene.periodic(1), 1);
  VectorField corners;
  for (int j = 0; j < y.corners(); ++j)
    for (int i = 0; i < x.corners(); ++i) corners.emplace_back(x.corner(i), y.corner(j));
  return corners;
}

}  // namespace

VectorField cell_corners(const Scene& scene) {
  return lattice(scene, {1, 1});
}

VectorField sample_points(const Scene& scene, const Scheme& scheme) {
  const auto parts = [&](std::size_t axis) {
    return scheme.basis == Scheme::Basis::Linear || scene.cells[axis] == 1 ? 1 : 4;
  };
  return lattice(scene, {parts(0), parts(1)});
}

std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Scheme& scheme, int threads) {
  scene.validate();
  scheme.validate();
  check_together(scene, scheme);
  if (threads == 0) threads = default_threads();
  switch (scheme.basis) {
    case Scheme::Basis::Linear:
      return make_linear_solver(scene, scheme, threads);
    case Scheme::Basis::Quadratic:
      return make_quadratic_solver(scene, scheme, threads);
    case Scheme::Basis::Cubic:
      return make_cubic_solver(scene, scheme, threads);
  }
  throw SceneError("a basis has no solver");
}

}  // namespace mpm
