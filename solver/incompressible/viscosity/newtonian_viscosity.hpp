#pragma once

#include <map>
#include <memory>

#include "solver/incompressible/space/solenoidal_factor.hpp"
#include "solver/incompressible/viscosity/viscosity.hpp"

namespace mpm::incompressible {

/// A constant viscosity: N(w) = nu Z^T (K Z w - walls), whose matrices are prepared once for every a
/// (SolenoidalFactor).
class NewtonianViscosity final : public Viscosity {
 public:
  /// `nu`: kinematic viscosity [m2/s].
  NewtonianViscosity(const Scene& scene, const VelocitySpace& space, const SparseMatrix& basis,
                     const SparseMatrix& mass, double nu, const WallShares& shares = {})
      : nu_(nu),
        space_(space),
        basis_(basis),
        mass_(mass),
        form_(space, scene, shares),
        matrix_(reduced_to(basis, form_.matrix())) {}

  [[nodiscard]] VectorXd force(const VectorXd& w, double t) const override {
    return nu_ * (matrix_ * w - basis_.transpose() * form_.wall_load(t));
  }

  [[nodiscard]] std::optional<VectorXd> force_on_velocities(const VectorXd& w, double t) const override {
    return nu_ * (form_.matrix() * (basis_ * w) - form_.wall_load(t));
  }

  [[nodiscard]] Solution solved(double a, double t, const VectorXd& load, const VectorXd&) override {
    constexpr std::size_t most = 6;  // steps of a run differ where they end on an output
    if (factors_.size() > most && !factors_.contains(a)) factors_.clear();
    std::unique_ptr<SolenoidalFactor>& factor = factors_[a];
    if (!factor)
      factor = std::make_unique<SolenoidalFactor>(space_, mass_ + (a * nu_) * matrix_,
                                                  Diffusion{a * nu_, form_.held()});
    return {factor->solve(load + (a * nu_) * (basis_.transpose() * form_.wall_load(t))), true};
  }

 private:
  double nu_;
  const VelocitySpace& space_;
  const SparseMatrix &basis_, &mass_;
  ViscousForm form_;
  SparseMatrix matrix_;
  std::map<double, std::unique_ptr<SolenoidalFactor>> factors_;  // by a
};

}  // namespace mpm::incompressible
