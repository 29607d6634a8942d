#include "solver/table/solver_table.hpp"

namespace mpm {

std::unique_ptr<Simulation> make_cubic_solver(const Scene& scene, const Scheme& scheme, int threads) {
  return make_solver_of_degree<3>(scene, scheme, threads);
}

std::unique_ptr<Simulation> make_cubic_general_solver(const Scene& scene, const Scheme& scheme) {
  return make_general_solver_on<BSpline<3>>(scene, scheme);
}

}  // namespace mpm
