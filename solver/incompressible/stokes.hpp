#pragma once

#include <memory>

#include "solver/incompressible/incompressible_scheme.hpp"
#include "solver/incompressible/space/solenoidal_factor.hpp"
#include "solver/incompressible/viscosity/viscosity.hpp"

namespace mpm::incompressible {

/// Viscosity, walls and body forces under the constraint of incompressibility. Velocities are sought among
/// the solenoidal ones alone, W = Z w, so that the pressure, whose gradient is orthogonal to them, drops out,
/// and what is left is symmetric and positive definite; for a Newtonian fluid, Z^T (M + a nu K) Z, it is also
/// the same at every step of the same length: prepared once for each (SolenoidalFactor).
class Stokes {
 public:
  Stokes(const Scene& scene, const VelocitySpace& space, const ExactMass& mass,
         const WallShares& shares = {});

  /// The solenoidal velocity nearest to the given one in energy: what pressure leaves of it.
  [[nodiscard]] VectorXd solenoidal_part(const VectorXd& velocity) const;

  /// A velocity Z w between the ends of a step, where forces are taken.
  struct Stage {
    VectorXd w;
    double t;       ///< [s]
    double weight;  ///< its part of the step
  };
  struct Step {
    VectorXd end;           ///< velocity after the step, solenoidal
    Vec2 impulse;           ///< of body and wall forces, per density [m3/s]
    bool converged = true;  ///< whether a viscosity that varies was solved for
    std::vector<Stage> stages;
  };
  /// A step from a solenoidal velocity at t to t + dt [s] by the rule.
  [[nodiscard]] Step advanced(const VectorXd& start, double t, double dt,
                              IncompressibleScheme::Stepping rule);

  /// What pressure had to give for velocities to change by `change` over a step of dt [s] with these stages:
  /// integral of p/rho div N_i on every velocity [m3/s2]; none where the viscosity does not say.
  [[nodiscard]] std::optional<VectorXd> load_of_pressure(const VectorXd& change, double dt,
                                                         const std::vector<Stage>& stages) const;

 private:
  /// Body forces at a time, on velocities [m3/s2].
  [[nodiscard]] VectorXd forces(double t) const;
  /// Along periodic directions the sum of all forces, what resists included, on a velocity; along others what
  /// the momentum gained by.
  [[nodiscard]] Vec2 impulse(const VectorXd& body, const std::vector<Stage>& stages, double dt,
                             const VectorXd& gained) const;

  const Scene& scene_;
  const VelocitySpace& space_;
  const ExactMass& mass_;
  SparseMatrix basis_, reduced_mass_;
  SolenoidalFactor mass_factor_;
  std::unique_ptr<Viscosity> viscosity_;
  VectorXd last_;                                // the coordinates of the last solution
  VectorXd traction_;                            // of sides that pull, which stays
  std::array<VectorXd, 2> uniform_;              // unit velocity along x, y: integrals over its unknowns [m2]
  std::array<VectorXd, 2> uniform_coordinates_;  // w of that velocity, where the direction is periodic
};

}  // namespace mpm::incompressible
