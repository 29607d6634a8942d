#pragma once

#include <array>

namespace reference {

/// A vortex in a square with walls. SI units.
struct WalledVortexParameters {
  double side = 0.0;                 ///< L [m] > 0
  double amplitude = 0.0;            ///< U, largest velocity at t = 0 [m/s] > 0
  double decay_rate = 0.0;           ///< lambda [1/s] >= 0; 0: a steady flow
  double kinematic_viscosity = 0.0;  ///< nu [m2/s] >= 0
};

/// A manufactured solution (Roache, J. Fluids Eng. 124 (2002) 4) of the incompressible Navier-Stokes
/// equations in the square [0, L]^2 whose walls all hold the fluid: with s = pi/L and E = exp(-lambda t),
///   u = U E sin^2(s x) sin(2 s y),   v = -U E sin(2 s x) sin^2(s y),
/// under the acceleration b = v_t + (v.grad) v - nu lap v. Its pressure is uniform; b is no gradient.
class WalledVortex {
 public:
  /// Throws std::invalid_argument for parameters out of the ranges above, or not finite.
  explicit WalledVortex(const WalledVortexParameters& parameters);

  /// Velocity [m/s] at (x, y) [m] and t [s].
  [[nodiscard]] std::array<double, 2> velocity(double x, double y, double t) const;
  /// b [m/s2].
  [[nodiscard]] std::array<double, 2> acceleration(double x, double y, double t) const;
  /// Root mean square speed over the square, sqrt(3/8) U E [m/s].
  [[nodiscard]] double rms_speed(double t) const;

 private:
  WalledVortexParameters parameters_;
  double s_;  // [rad/m]
};

}  // namespace reference
