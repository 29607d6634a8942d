#include "solver/table/solver_table.hpp"

namespace mpm {

std::unique_ptr<Simulation> make_quadratic_solver(const Scene& scene, const Scheme& scheme, int threads) {
  return make_solver_of_degree<2>(scene, scheme, threads);
}

std::unique_ptr<Simulation> make_quadratic_general_solver(const Scene& scene, const Scheme& scheme) {
  return make_general_solver_on<BSpline<2>>(scene, scheme);
}

}  // namespace mpm
