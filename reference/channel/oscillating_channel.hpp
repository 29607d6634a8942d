#pragma once

#include <complex>

namespace reference {

/// A plane channel, 0 <= y <= H, driven periodically. SI units.
struct OscillatingChannelParameters {
  double height = 0.0;               ///< H [m] > 0
  double kinematic_viscosity = 0.0;  ///< nu [m2/s] > 0
  double angular_frequency = 0.0;    ///< omega [rad/s] > 0
  double body_acceleration = 0.0;    ///< F [m/s2]: F cos(omega t) along the plates
  double plate_velocity = 0.0;       ///< V0 [m/s]: the plate at y = H moves with V0 cos(omega t)
};

/// Periodic state of a Newtonian channel whose plate at y = 0 is at rest: the real part of U(y) exp(i omega
/// t) with i omega U = F + nu U'' and U(0) = 0, U(H) = V0. With lambda = sqrt(i omega/nu) = (1 + i)/delta,
///   plate: U = V0 sinh(lambda y)/sinh(lambda H)              (Stokes' second problem in a gap),
///   force: U = F/(i omega) [1 - cosh(lambda z)/cosh(lambda H/2)], z = y - H/2   (plane Womersley flow),
/// and their sum. Sources: Landau & Lifshitz, Fluid Mechanics, section 24; Womersley 1955 for the pipe. The
/// Womersley number is (H/2) sqrt(omega/nu). Written so that neither a thin Stokes layer overflows nor a slow
/// drive cancels.
class OscillatingChannel {
 public:
  /// Throws std::invalid_argument for arguments out of the ranges above, or not finite, or without a drive.
  explicit OscillatingChannel(const OscillatingChannelParameters& parameters);

  /// U(y) [m/s], 0 <= y <= H.
  [[nodiscard]] std::complex<double> amplitude(double y) const;
  /// u(y, t) [m/s], any t [s].
  [[nodiscard]] double velocity(double y, double t) const;
  /// (H/2) sqrt(omega/nu) [-].
  [[nodiscard]] double womersley_number() const;

 private:
  OscillatingChannelParameters parameters_;
  std::complex<double> lambda_;
};

}  // namespace reference
