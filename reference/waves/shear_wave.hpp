#pragma once

#include <array>

namespace reference {

/// A transverse shear wave, carried along by a uniform stream. SI units.
struct ShearWaveParameters {
  double amplitude = 0.0;                   ///< U [m/s]
  std::array<double, 2> wave_vector{};      ///< k [rad/m], not zero
  double kinematic_viscosity = 0.0;         ///< nu [m2/s] >= 0
  std::array<double, 2> stream_velocity{};  ///< W [m/s]
};

/// Decaying shear wave, an exact solution of the Navier-Stokes equations at any amplitude (the wave
/// transports nothing along k, so the nonlinear term vanishes and the pressure stays uniform):
///   v(x, t) = W + U t sin(k.(x - W t)) exp(-nu |k|^2 t),  t = (k_y, -k_x)/|k|,
/// so k = (0, k) gives u = U sin(k y) exp(-nu k^2 t).
class ShearWave {
 public:
  /// Throws std::invalid_argument for a zero wave vector, a negative viscosity or anything not finite.
  explicit ShearWave(const ShearWaveParameters& parameters);

  /// Velocity vector [m/s] at (x, y) [m] and t [s].
  [[nodiscard]] std::array<double, 2> velocity(double x, double y, double t) const;
  /// Where the fluid that is at X [m] at t = 0 is at time t [m]. The phase k.(x - W t) of a fluid particle
  /// never changes, so it moves with W and, along the wave's crest, by the time integral of its velocity.
  [[nodiscard]] std::array<double, 2> path(double x, double y, double t) const;
  /// nu |k|^2 [1/s].
  [[nodiscard]] double decay_rate() const;

 private:
  ShearWaveParameters parameters_;
};

}  // namespace reference
