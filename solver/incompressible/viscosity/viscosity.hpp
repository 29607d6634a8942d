#pragma once

#include <memory>
#include <optional>

#include "solver/incompressible/viscosity/viscous_form.hpp"

namespace mpm::incompressible {

/// Viscosity and walls over the coordinates w of the solenoidal velocities Z w, per density: the forces N(w)
/// that resist them.
class Viscosity {
 public:
  virtual ~Viscosity() = default;

  /// N(w), with the walls' motion at time t [s]; on a coordinate, in units of [m3/s2] where that is a
  /// velocity.
  [[nodiscard]] virtual VectorXd force(const VectorXd& w, double t) const = 0;

  /// The same on the velocities themselves, gradients included, which a pressure balances [m3/s2]; none where
  /// it is not at hand.
  [[nodiscard]] virtual std::optional<VectorXd> force_on_velocities(const VectorXd& w, double t) const {
    static_cast<void>(w), static_cast<void>(t);
    return std::nullopt;
  }

  struct Solution {
    VectorXd w;
    bool converged = true;
  };
  /// Solves Z^T M Z w + a N(w) = load, a > 0 [s], from a guess.
  [[nodiscard]] virtual Solution solved(double a, double t, const VectorXd& load, const VectorXd& guess) = 0;
};

/// For the scene's fluid. `basis` is Z, `mass` Z^T M Z; both, the scene and the space must outlive it.
std::unique_ptr<Viscosity> make_viscosity(const Scene& scene, const VelocitySpace& space,
                                          const SparseMatrix& basis, const SparseMatrix& mass,
                                          const WallShares& shares = {});

}  // namespace mpm::incompressible
