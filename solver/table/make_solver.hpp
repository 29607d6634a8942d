#pragma once

#include <memory>

#include "solver/simulation.hpp"

namespace mpm {

// One function a basis, each in a translation unit of its own: solver_<basis>.cpp.
std::unique_ptr<Simulation> make_linear_solver(const Scene& scene, const Scheme& scheme, int threads);
std::unique_ptr<Simulation> make_quadratic_solver(const Scene& scene, const Scheme& scheme, int threads);
std::unique_ptr<Simulation> make_cubic_solver(const Scene& scene, const Scheme& scheme, int threads);

}  // namespace mpm
