#pragma once

#include "solver/incompressible/viscosity/shear_viscosity.hpp"

namespace mpm::incompressible {

/// The viscosity of a regularised yield stress. Newton's method as YieldNewton (solver/viscosity) has it: the
/// place of each Gauss point on the flow curve is an unknown of its own, which moves along the curve by
/// stress + c times rate; eliminated point by point, what is left has the tangent at those places.
class YieldViscosity final : public ShearViscosity {
 public:
  YieldViscosity(const Scene& scene, const VelocitySpace& space, const SparseMatrix& mass,
                 const HerschelBulkley& fluid, const WallShares& shares = {});

  [[nodiscard]] Solution solved(double a, double t, const VectorXd& load, const VectorXd& guess) override;

 private:
  void move(State& place, const State& flow, double share) const;
  [[nodiscard]] VectorXd linearised_force(const State& flow, const State& place, Eigen::Index size_of_w,
                                          double t) const;

  HerschelBulkley fluid_;  // per density
};

}  // namespace mpm::incompressible
