#pragma once

#include "reference/channel/channel_solution.hpp"

namespace reference {

/// Start-up from rest of a Newtonian fluid between a plate at rest, y = 0, and a side at y = H on which a
/// stress pulls from t = 0: u_t = nu u_yy, u(0) = 0, u_y(H) = tau/mu. With s = tau/mu and l_n = (n + 1/2)
/// pi/H (Carslaw & Jaeger, sec. 3.8):
///   u = s y - (2 s/H) sum_n (-1)^n/l_n^2 sin(l_n y) exp(-nu l_n^2 t),
/// and by images, d = 2 sqrt(nu t):
///   u = s d sum_k (-1)^k [ierfc(((2k+1) H - y)/d) - ierfc(((2k+1) H + y)/d)].
/// Images up to nu t/H^2 = 0.1, the series beyond. SI units.
class StressDrivenChannel final : public ChannelSolution {
 public:
  /// Height [m] > 0, kinematic viscosity [m2/s] > 0, stress over density [m2/s2], not zero. Throws
  /// std::invalid_argument.
  StressDrivenChannel(double height, double kinematic_viscosity, double stress_over_density);

  [[nodiscard]] double velocity(double y, double t) const override;
  [[nodiscard]] double gradient(double y, double t) const override;
  [[nodiscard]] double steady_maximum() const override;
  [[nodiscard]] double stated_error() const override { return 1e-14; }
  [[nodiscard]] std::string description() const override;

  /// Either series by itself, for the one to be held against the other; t > 0.
  [[nodiscard]] double by_modes(double y, double t) const;
  [[nodiscard]] double by_images(double y, double t) const;

 private:
  double height_, nu_, rate_;  // rate_: steady gradient [1/s]
};

}  // namespace reference
