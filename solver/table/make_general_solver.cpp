#include "solver/scene/scene.hpp"
#include "solver/table/make_solver.hpp"

namespace mpm {

std::unique_ptr<Simulation> make_general_solver(const Scene& scene, const Scheme& scheme) {
  switch (scheme.basis) {
    case Scheme::Basis::Linear:
      return make_linear_general_solver(scene, scheme);
    case Scheme::Basis::Quadratic:
      return make_quadratic_general_solver(scene, scheme);
    case Scheme::Basis::Cubic:
      return make_cubic_general_solver(scene, scheme);
  }
  throw SceneError("a basis has no solver");
}

}  // namespace mpm
