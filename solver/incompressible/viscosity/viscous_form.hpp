#pragma once

#include "solver/incompressible/space/exact_mass.hpp"
#include "solver/incompressible/wall_shares.hpp"

namespace mpm::incompressible {

/// Of Nitsche's method, times k/h: what holds a velocity to a wall's.
constexpr double wall_penalty = 6;

/// Viscosity of a Newtonian fluid in weak form, integral of grad u : grad w, over the unknowns of a velocity
/// space. What sticks to a wall is held there by Nitsche's method with the penalty 6 k/h, which disarms the
/// corners of a cavity (the tangential velocity may miss the wall's by an error of the method's order); a
/// wall of slip length b adds u w/b.
class ViscousForm {
 public:
  ViscousForm(const VelocitySpace& space, const Scene& scene, const WallShares& shares = {});

  /// K for a viscosity of 1 m2/s [1].
  [[nodiscard]] const SparseMatrix& matrix() const { return matrix_; }

  /// Of the velocity along the walls that end an axis, over all its functions of degree k - 1 there: its
  /// stiffness with what walls add [1/m].
  [[nodiscard]] const std::array<SparseMatrix, 2>& held() const { return held_; }

  /// What walls in motion at time t [s] add to the right side, for a viscosity of 1 m2/s [m/s].
  [[nodiscard]] VectorXd wall_load(double t) const;

 private:
  struct Wall {
    const Side* side;
    int along;      // axis and component of its motion
    VectorXd load;  // of unit velocity
  };
  const VelocitySpace& space_;
  SparseMatrix matrix_;
  std::array<SparseMatrix, 2> held_;
  std::vector<Wall> walls_;
};

}  // namespace mpm::incompressible
