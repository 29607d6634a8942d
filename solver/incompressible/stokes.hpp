#pragma once

#include <Eigen/SparseCholesky>
#include <map>
#include <memory>

#include "solver/incompressible/incompressible_scheme.hpp"
#include "solver/incompressible/viscous_form.hpp"

namespace mpm::incompressible {

/// Viscosity, walls and body forces of a Newtonian fluid under the constraint of incompressibility.
/// Velocities are sought among the solenoidal ones alone, W = Z w, so that the pressure, whose gradient is
/// orthogonal to them, drops out, and what is left, Z^T (M + a nu K) Z, is symmetric, positive definite and
/// the same at every step: factorised once.
class Stokes {
 public:
  /// `nu`: kinematic viscosity [m2/s].
  Stokes(const Scene& scene, const VelocitySpace& space, const ExactMass& mass, double nu);

  /// The solenoidal velocity nearest to the given one in energy: what pressure leaves of it.
  [[nodiscard]] VectorXd solenoidal_part(const VectorXd& velocity) const;

  struct Step {
    VectorXd end;  ///< velocity after the step, solenoidal
    Vec2 impulse;  ///< of body and wall forces, per density [m3/s]
  };
  /// A step from a solenoidal velocity at t to t + dt [s] by the rule.
  [[nodiscard]] Step advanced(const VectorXd& start, double t, double dt,
                              IncompressibleScheme::Stepping rule);

 private:
  using Factor = Eigen::SimplicialLLT<SparseMatrix>;

  /// Solves Z^T (M + a nu K) Z w = Z^T load, and gives Z w.
  [[nodiscard]] VectorXd solved(double a, const VectorXd& load);
  /// Walls and body forces at a time [m3/s2].
  [[nodiscard]] VectorXd forces(double t) const;
  /// Along periodic directions the sum of all forces on a velocity; along others what the momentum gained by.
  [[nodiscard]] Vec2 impulse(const VectorXd& summed_forces, const VectorXd& gained) const;

  const Scene& scene_;
  const VelocitySpace& space_;
  const ExactMass& mass_;
  double nu_;
  ViscousForm viscous_;
  SparseMatrix basis_, reduced_mass_, reduced_viscosity_;
  Factor mass_factor_;
  std::map<double, std::unique_ptr<Factor>> factors_;  // by a
  std::array<VectorXd, 2> uniform_;  // unit velocity along x, y: integrals over its unknowns [m2]
};

}  // namespace mpm::incompressible
