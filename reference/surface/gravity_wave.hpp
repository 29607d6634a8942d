#pragma once

#include <complex>

namespace reference {

/// A small standing wave on a layer of fluid over a bottom along which it slips freely. SI units.
struct GravityWaveParameters {
  double wavenumber = 0;           ///< k [rad/m] > 0
  double depth = 0;                ///< H [m] > 0
  double gravity = 0;              ///< g [m/s2] > 0
  double kinematic_viscosity = 0;  ///< nu [m2/s] >= 0
};

/// Linear waves of an incompressible viscous fluid, v = V(y) cos(k x) exp(s t): the normal modes that the
/// initial-value problem of Prosperetti 1981 (Phys. Fluids 24, 1217) comes to, for finite depth and a bottom
/// without shear stress, from V = A sinh(k y) + B sinh(m y), m^2 = k^2 + s/nu, no stress at the surface:
///   s^2 + g k T (m^2 - k^2)/(m^2 + k^2) + 2 nu k^2 s [1 - 2 k m T coth(m H)/(m^2 + k^2)] = 0,  T = tanh(k
///   H),
/// which for infinite depth is (s + 2 nu k^2)^2 + g k = 4 nu^2 k^3 m (Lamb, Hydrodynamics, art. 349), and for
/// small nu has s = -2 nu k^2 +- i sqrt(g k T).
class GravityWave {
 public:
  /// Throws std::invalid_argument for parameters out of the ranges above, and for a wave that does not
  /// oscillate.
  explicit GravityWave(const GravityWaveParameters& parameters);

  /// s, with a positive imaginary part [1/s].
  [[nodiscard]] std::complex<double> rate() const { return rate_; }
  /// sqrt(g k tanh(k H)): without viscosity [rad/s].
  [[nodiscard]] double inviscid_frequency() const;

  /// Velocity (u, v) [m/s] at x, y [m] and t [s] of the wave whose surface is level at t = 0 and rises there
  /// with `amplitude` cos(k x) [m/s].
  struct Velocity {
    double u, v;
  };
  [[nodiscard]] Velocity velocity(double amplitude, double x, double y, double t) const;

 private:
  [[nodiscard]] std::complex<double> dispersion(std::complex<double> s) const;

  GravityWaveParameters parameters_;
  std::complex<double> rate_;
};

}  // namespace reference
