#pragma once

#include <array>

namespace reference {

/// A square array of decaying vortices. SI units.
struct TaylorGreenParameters {
  double amplitude = 0.0;            ///< U, largest velocity at t = 0 [m/s] > 0
  double period = 0.0;               ///< L along x and y [m] > 0: four vortices, each L/2 wide, fill L x L
  double kinematic_viscosity = 0.0;  ///< nu [m2/s] >= 0
  double density = 0.0;              ///< rho0 [kg/m3] > 0
};

/// The Taylor-Green vortex, an exact solution of the incompressible Navier-Stokes equations in the plane
/// (Taylor & Green, Proc. R. Soc. Lond. A 158 (1937) 499; Taylor, Phil. Mag. 46 (1923) 671): with k = 2 pi/L
///   u =  U sin(k x) cos(k y) exp(-2 nu k^2 t),
///   v = -U cos(k x) sin(k y) exp(-2 nu k^2 t),
///   p = rho0 U^2/4 (cos 2 k x + cos 2 k y) exp(-4 nu k^2 t), of mean zero.
/// The pressure gradient balances advection, so the vortices decay in place.
class TaylorGreen {
 public:
  /// Throws std::invalid_argument for parameters out of the ranges above, or not finite.
  explicit TaylorGreen(const TaylorGreenParameters& parameters);

  /// Velocity vector [m/s] at (x, y) [m] and t [s].
  [[nodiscard]] std::array<double, 2> velocity(double x, double y, double t) const;
  /// Pressure [Pa].
  [[nodiscard]] double pressure(double x, double y, double t) const;
  /// 2 nu k^2 [1/s]: velocities fall as exp(-decay_rate t).
  [[nodiscard]] double decay_rate() const;
  /// Root mean square speed over the box, U/sqrt(2) exp(-2 nu k^2 t) [m/s].
  [[nodiscard]] double rms_speed(double t) const;
  /// Kinetic energy of one period, rho0 L^2 U^2/4 exp(-4 nu k^2 t), per unit depth [J/m].
  [[nodiscard]] double kinetic_energy(double t) const;

 private:
  TaylorGreenParameters parameters_;
  double wavenumber_;  // k [rad/m]
};

}  // namespace reference
