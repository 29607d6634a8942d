#pragma once

#include <memory>

#include "solver/simulation.hpp"

namespace mpm {

// A basis each, in a translation unit of its own: solver_<basis>.cpp.
std::unique_ptr<Simulation> make_linear_solver(const Scene& scene, const Scheme& scheme, int threads);
std::unique_ptr<Simulation> make_quadratic_solver(const Scene& scene, const Scheme& scheme, int threads);
std::unique_ptr<Simulation> make_cubic_solver(const Scene& scene, const Scheme& scheme, int threads);

/// The general solver, which visits particle by particle, in the plane, also where others cover scene and
/// scheme: what those are held against.
std::unique_ptr<Simulation> make_general_solver(const Scene& scene, const Scheme& scheme);
std::unique_ptr<Simulation> make_linear_general_solver(const Scene& scene, const Scheme& scheme);
std::unique_ptr<Simulation> make_quadratic_general_solver(const Scene& scene, const Scheme& scheme);
std::unique_ptr<Simulation> make_cubic_general_solver(const Scene& scene, const Scheme& scheme);

}  // namespace mpm
