#pragma once

namespace reference {

/// Speed of sound c = sqrt(7 K/rho0) [m/s] of the Tait equation of state P = K [(rho/rho0)^7 - 1];
/// K [Pa] and rho0 [kg/m3] positive, else std::invalid_argument.
double tait_sound_speed(double bulk_constant, double reference_density);

/// A standing sound wave u = U sin(k x + phase) at t = 0, density unperturbed. SI units.
struct AcousticWaveParameters {
  double amplitude = 0.0;            ///< U [m/s]; the solution is linear, so U << c
  double wavenumber = 0.0;           ///< k [rad/m] > 0
  double phase = 0.0;                ///< [rad]; pi/2 gives a cosine
  double sound_speed = 0.0;          ///< c [m/s] > 0
  double kinematic_viscosity = 0.0;  ///< nu [m2/s] >= 0
  double reference_density = 0.0;    ///< rho0 [kg/m3] > 0
};

/// Small-amplitude standing wave in a weakly compressible Newtonian fluid with stress 2 mu D - (2/3) mu tr(D)
/// I. In plane strain a wave along x has normal viscous stress (4/3) mu u_x, so
///   u_tt = c^2 u_xx + (4/3) nu u_xxt,  rho_t = -rho0 u_x,
/// which each Fourier mode solves as a damped oscillator with damping rate g = (2/3) nu k^2 and undamped
/// frequency c k. Overdamped waves (g >= c k) are covered: angular frequency 0, period infinite.
class AcousticWave {
 public:
  /// Throws std::invalid_argument for arguments out of the ranges above, or not finite.
  explicit AcousticWave(const AcousticWaveParameters& parameters);

  /// u(x, t) [m/s], t >= 0.
  [[nodiscard]] double velocity(double x, double t) const;
  /// rho(x, t) - rho0 [kg/m3], t >= 0.
  [[nodiscard]] double density_perturbation(double x, double t) const;
  /// (2/3) nu k^2 [1/s]: the envelope of an underdamped wave is exp(-damping_rate t).
  [[nodiscard]] double damping_rate() const { return damping_; }
  /// sqrt(c^2 k^2 - damping_rate^2) [rad/s], 0 if overdamped.
  [[nodiscard]] double angular_frequency() const;
  /// 2 pi/angular_frequency [s], infinite if overdamped.
  [[nodiscard]] double period() const;

 private:
  struct Amplitudes {
    double velocity;  // f(t), f(0) = 1
    double integral;  // integral of f from 0 to t
  };
  [[nodiscard]] Amplitudes amplitudes(double t) const;

  AcousticWaveParameters parameters_;
  double damping_;
  double discriminant_;  // c^2 k^2 - damping^2
};

}  // namespace reference
