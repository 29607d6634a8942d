#pragma once

#include <cmath>
#include <limits>

#include "solver/viscosity/viscous_system.hpp"

namespace mpm {

/// Newton's method for one fluid. The system is the minimum of a convex function wherever shear stress grows
/// with shear rate, so that a line search on the function's slope along the Newton direction always makes
/// progress. A factorised matrix is kept while it still contracts the error (chord method): a Newtonian shear
/// flow factorises once in a run.
template <class Law>
class ViscousNewton final : public ImplicitViscosity {
 public:
  ViscousNewton(const Law& law, const Grid& grid, const WallNodes& walls) : law_(law), system_(grid, walls) {}

  ImplicitSolution solve(const StencilTable& table, const Particles& particles, const SparseMatrix& mass,
                         VectorField start, VectorField force, double dt, VectorField& velocity) override {
    system_.begin(table, particles, mass, start, force, dt, velocity);
    if (!system_.factorised()) factorise(velocity);
    bool fresh = false, converged = false;
    double last_change = std::numeric_limits<double>::infinity();
    VectorField residual(velocity.size()), step(velocity.size());
    residual_at(velocity, residual);
    for (int iteration = 0; iteration < most_iterations && !converged; ++iteration) {
      system_.direction(residual, step);
      double change = ViscousSystem::largest(step);
      if (!fresh && !(change <= contraction * last_change)) {
        factorise(velocity);
        system_.direction(residual, step);
        change = ViscousSystem::largest(step);
      }
      if (!std::isfinite(change)) break;
      converged = change <= tolerance * std::max(ViscousSystem::largest(velocity), system_.scale());
      if (converged) {  // too small a step to change the residual, which goes on to tell the walls' forces
        for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] += step[i];
        break;
      }
      const double fraction = advance(velocity, step, residual);
      // A cut step says nothing on how well the matrix contracts: take the present one's next time.
      fresh = fraction < 1;
      if (fresh) factorise(velocity);
      last_change = change;
    }
    return {system_.wall_impulse(), converged};
  }

 private:
  // Round-off in the residual, amplified by the condition of M + dt K, leaves a few 1e-14 of the velocity.
  static constexpr double tolerance = 1e-12;
  static constexpr double contraction = 0.1;
  static constexpr int most_iterations = 100;

  void residual_at(const VectorField& velocity, VectorField& residual) {
    system_.residual_at(
        velocity,
        [&](std::size_t, const Mat2& d) -> Mat2 {
          const double mu = system_.viscosity(law_, 2 * d.squaredNorm()).first;
          return 2 * mu * d - (2.0 / 3.0) * mu * d.trace() * Mat2::Identity();
        },
        residual);
  }

  void factorise(const VectorField& velocity) {
    system_.factorise([&](std::size_t p) -> ViscousSystem::Linearised {
      const Mat2 d = system_.strain_rate(velocity, p);
      const auto [mu, slope] = system_.viscosity(law_, 2 * d.squaredNorm());
      return {d, mu, slope};
    });
  }

  /// v += s step with s = 1, or smaller where the slope of the convex function has grown beyond the one at
  /// the start. Updates the residual and returns s.
  double advance(VectorField& velocity, const VectorField& step, VectorField& residual) {
    base_ = velocity;
    const double slope_at_start = dot(residual, step);
    double low = 0, high = 1, fraction = 1;
    for (int cut = 0; cut < 30; ++cut) {
      for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = base_[i] + fraction * step[i];
      residual_at(velocity, residual);
      if (!Law::needs_shear_rate || is_round_off(step)) break;
      const double slope = dot(residual, step);
      if (std::abs(slope) <= 0.5 * std::abs(slope_at_start)) break;
      // Still falling: the minimum lies beyond; a full step is never lengthened.
      if (slope < 0 && fraction == 1) break;
      (slope < 0 ? low : high) = fraction;
      fraction = 0.5 * (low + high);
    }
    return fraction;
  }

  [[nodiscard]] bool is_round_off(const VectorField& step) const {
    return ViscousSystem::largest(step) <= tolerance * system_.scale();
  }

  static double dot(const VectorField& a, const VectorField& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
  }

  Law law_;
  ViscousSystem system_;
  VectorField base_;  // work space
};

}  // namespace mpm
