#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "solver/material/rheology/dual_rate.hpp"
#include "solver/material/stress_update.hpp"
#include "solver/viscosity/viscous_system.hpp"

namespace mpm {

/// Newton's method for a regularised yield stress, whose flow curve has a corner: from a viscosity of
/// nu + m tau_y it bends to nu within shear rates of 1/m, so that the tangent at one iterate says nothing on
/// the next, and a line search cuts the step of all particles for the sake of one. Here each particle's place
/// on its flow curve is an unknown of its own, on which the strain rate depends through the linear system
/// alone: particles move along their curves by S + c 2 D (DualRate), in which stress and rate are both
/// nearly straight. Eliminated particle by particle, what is left is a system with the tangent at those
/// places. Four to nine iterations in the mean, whatever m. The idea: variables by which a steep graph is
/// parametrised, Brenner & Cancès 2017, SIAM J. Numer. Anal. 55, 1760; stresses as unknowns beside rates,
/// Chan, Golub & Mulet 1999, SIAM J. Sci. Comput. 20, 1964.
class YieldNewton final : public ImplicitViscosity {
  using Vec3 = Eigen::Vector3d;

 public:
  YieldNewton(const HerschelBulkley& law, const Grid& grid, const WallNodes& walls)
      : law_(law), system_(grid, walls) {}

  ImplicitSolution solve(const StencilTable& table, const Particles& particles, const SparseMatrix& mass,
                         const VectorField& start, const VectorField& force, double dt,
                         VectorField& velocity) override {
    system_.begin(table, particles, mass, start, force, dt, velocity);
    const DualRate curve(law_, system_.shear_scale());
    place_.resize(system_.particles());
    for (std::size_t p = 0; p < place_.size(); ++p) take(p, system_.strain_rate(velocity, p));
    VectorField residual(velocity.size()), step(velocity.size());
    bool converged = false;
    double last_change = std::numeric_limits<double>::infinity(), share = 1;
    for (iterations_ = 0; iterations_ < most_iterations && !converged; ++iterations_) {
      system_.factorise(place_);
      residual_at(velocity, residual);
      system_.direction(residual, step);
      const double change = ViscousSystem::largest(step);
      if (!std::isfinite(change)) break;
      for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] += step[i];
      const double speed = std::max(ViscousSystem::largest(velocity), system_.scale());
      const double missing = missed(velocity) * system_.cell();
      converged = (change <= tolerance * speed && missing <= rate_tolerance * speed) ||
                  (change <= round_off * speed && missing <= round_off * speed && change >= last_change);
      share = next_share(share, change, last_change, iterations_);
      last_change = change;
      // The linear system is solved: what its residual says of the walls is their force.
      if (converged) residual_at(velocity, residual);
      for (std::size_t p = 0; p < place_.size() && !converged; ++p) {
        const auto& [at, mu, slope] = place_[p];
        take(p, strain_rate_of(
                    curve.moved(rate_of(at), mu, slope, rate_of(system_.strain_rate(velocity, p)), share)));
      }
    }
    return {system_.wall_impulse(), converged};
  }

  /// Linear systems solved by the last call.
  [[nodiscard]] int iterations() const { return iterations_; }

 private:
  // As ViscousNewton. A particle's rate is a difference of velocities over a cell.
  static constexpr double tolerance = 1e-12, rate_tolerance = 1e-10;
  // Where steps below this do not get smaller, round-off makes them: a plug's viscosity is (nu + m tau_y)/nu
  // times that beside it.
  static constexpr double round_off = 1e-8;
  static constexpr int most_iterations = 200;

  /// A strain rate as a vector whose length is the shear rate sqrt(2 D:D).
  static Vec3 rate_of(const Mat2& d) {
    constexpr double root = std::numbers::sqrt2;
    return {root * d(0, 0), root * d(1, 1), 2 * d(0, 1)};
  }
  static Mat2 strain_rate_of(const Vec3& rate) {
    constexpr double root = std::numbers::sqrt2;
    Mat2 d;
    d << rate[0] / root, 0.5 * rate[2], 0.5 * rate[2], rate[1] / root;
    return d;
  }

  /// Largest distance between a particle's strain rate and that of its place [1/s].
  [[nodiscard]] double missed(const VectorField& velocity) const {
    double most = 0;
    for (std::size_t p = 0; p < place_.size(); ++p)
      most = std::max(most, (system_.strain_rate(velocity, p) - place_[p].d).norm());
    return most;
  }

  void take(std::size_t p, const Mat2& d) {
    const auto [mu, slope] = system_.viscosity(law_, 2 * d.squaredNorm());
    place_[p] = {d, mu, slope};
  }

  void residual_at(const VectorField& velocity, VectorField& residual) {
    system_.strain_rates(velocity, rate_);
    system_.residual_at(
        velocity,
        [&](std::size_t p) -> Mat2 {
          const Mat2& d = rate_[p];
          const auto& [at, mu, slope] = place_[p];
          return viscous_stress(mu, d) + (8 * slope * at.cwiseProduct(d - at).sum()) * at;
        },
        residual);
  }

  HerschelBulkley law_;
  ViscousSystem system_;
  int iterations_ = 0;
  std::vector<Linearised> place_;  // of each particle on its flow curve
  std::vector<Mat2> rate_;         // of each particle where the last residual was
};

}  // namespace mpm
