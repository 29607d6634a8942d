#pragma once

#include <cmath>
#include <limits>

#include "solver/material/stress_update.hpp"
#include "solver/viscosity/viscous_system.hpp"

namespace mpm {

/// Newton's method for one fluid. The system is the minimum of a convex function wherever shear stress grows
/// with shear rate, so that a line search on the function's slope along the Newton direction always makes
/// progress. A factorised tangent is kept while it still contracts the error (chord method): a Newtonian
/// shear flow factorises once in a run.
template <class Law>
class ViscousNewton final : public ImplicitViscosity {
 public:
  ViscousNewton(const Law& law, const Grid& grid, const WallNodes& walls) : law_(law), system_(grid, walls) {}

  ImplicitSolution solve(const StencilTable& table, const Particles& particles, const SparseMatrix& mass,
                         const VectorField& start, const VectorField& force, double dt,
                         VectorField& velocity) override {
    system_.begin(table, particles, mass, start, force, dt, velocity);
    const bool is_exact = is_linear && system_.is_strip();
    if (is_exact) {
      if (!system_.is_current()) {
        residual_at(velocity);
        factorise();
      }
      system_.linear_residual(velocity, residual_);
    } else {
      residual_at(velocity);
      if (!system_.factorised()) factorise();
    }
    // A tangent costs about three residuals on a strip, tens of them in a plane.
    const double most_contraction = system_.is_strip() ? 0.01 : 0.1;
    bool fresh = false;
    double last_change = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      system_.direction(residual_, step_);
      double change = ViscousSystem::largest(step_);
      if (!is_exact && !fresh && !(change <= most_contraction * last_change)) {
        factorise();
        system_.direction(residual_, step_);
        change = ViscousSystem::largest(step_);
      }
      if (!std::isfinite(change)) break;
      const double speed = std::max(ViscousSystem::largest(velocity), system_.scale());
      const double left = std::isfinite(last_change) ? change * change / last_change : change;
      if (is_exact || change <= tolerance * speed || left <= 0.1 * tolerance * speed) {
        for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] += step_[i];
        system_.close_walls(step_);
        return {system_.wall_impulse(), true};
      }
      const double fraction = advance(velocity);
      // A cut step says nothing on how well the matrix contracts: take the present one's next time.
      fresh = fraction < 1;
      if (fresh) factorise();
      last_change = change;
    }
    return {system_.wall_impulse(), false};
  }

 private:
  static constexpr bool is_linear = !Law::needs_shear_rate;
  // Round-off in the residual, amplified by the condition of M + dt K, leaves a few 1e-14 of the velocity.
  static constexpr double tolerance = 1e-12;
  static constexpr int most_iterations = 100;
  static constexpr Eigen::Index block = 32;  // viscosities that come from one call, in vector registers
  using Array = Eigen::Array<double, block, 1>;

  void residual_at(const VectorField& velocity) {
    system_.strain_rates(velocity, rate_);
    if constexpr (is_linear) {
      mu_.assign(rate_.size(), law_.viscosity());
    } else {
      shear_squared_.resize((rate_.size() + block - 1) / block * block, 1.0);
      for (std::size_t p = 0; p < rate_.size(); ++p)
        shear_squared_[p] = std::max(2 * rate_[p].squaredNorm(), system_.least_shear_squared());
      viscosities(1, mu_);
    }
    system_.residual_at(
        velocity, [&](std::size_t p) { return viscous_stress(mu_[p], rate_[p]); }, residual_);
  }

  /// Of the particles' shear rates squared, times a factor.
  void viscosities(double factor, ScalarField& mu) const {
    mu.resize(shear_squared_.size());
    for (std::size_t first = 0; first < mu.size(); first += block) {
      const Array q = factor * Eigen::Map<const Array>(shear_squared_.data() + first);
      Eigen::Map<Array>(mu.data() + first) = law_.viscosity(q);
    }
  }

  /// Takes the tangent where the last residual was.
  void factorise() {
    constexpr double e = 1e-7;  // relative: truncation e and round-off 1e-16/e are both below 1e-7
    if constexpr (!is_linear) viscosities(1 + e, mu_beyond_);
    law_there_.resize(rate_.size());
    for (std::size_t p = 0; p < rate_.size(); ++p) {
      law_there_[p] = {rate_[p], mu_[p], 0};
      if constexpr (!is_linear)  // not below the slope at which shear stress would fall with shear rate
        law_there_[p].slope = std::max((mu_beyond_[p] - mu_[p]) / e, -0.4995 * mu_[p]) / shear_squared_[p];
    }
    system_.factorise(law_there_);
  }

  /// v += s step with s = 1, or smaller where the slope of the convex function has grown beyond the one at
  /// the start. Updates the residual and returns s.
  double advance(VectorField& velocity) {
    base_ = velocity;
    const double slope_at_start = dot(residual_, step_);
    double low = 0, high = 1, fraction = 1;
    for (int cut = 0; cut < 30; ++cut) {
      for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = base_[i] + fraction * step_[i];
      residual_at(velocity);
      if (is_linear || is_round_off()) break;
      const double slope = dot(residual_, step_);
      if (std::abs(slope) <= 0.5 * std::abs(slope_at_start)) break;
      // Still falling: the minimum lies beyond; a full step is never lengthened.
      if (slope < 0 && fraction == 1) break;
      (slope < 0 ? low : high) = fraction;
      fraction = 0.5 * (low + high);
    }
    return fraction;
  }

  [[nodiscard]] bool is_round_off() const {
    return ViscousSystem::largest(step_) <= tolerance * system_.scale();
  }

  static double dot(const VectorField& a, const VectorField& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
  }

  Law law_;
  ViscousSystem system_;
  // Work space; that of the particles as the last residual left it.
  VectorField residual_, step_, base_;
  std::vector<Mat2> rate_;
  ScalarField shear_squared_, mu_, mu_beyond_;
  std::vector<Linearised> law_there_;
};

}  // namespace mpm
