#pragma once

#include <vector>

namespace reference {

/// A power-law fluid, tau = nu_0 |w|^(n-1) w, above a plate that is set in motion at t = 0: the fluid speed v
/// - relative to the far fluid - at a distance s from the plate. Its gradient obeys the porous-medium
/// equation with a point source, whose solution is Barenblatt's: with theta = (nu_0 t)^(1/(n+1)) and xi =
/// s/theta,
///   |dv/ds| = (1/theta) [C - k xi^2]_+^(1/(n-1)),  k = (n-1)/(2 n (n+1)),
/// C from the area under it, V0 (Barenblatt 1952; Vazquez, The Porous Medium Equation, 2007, ch. 4). For n >
/// 1 there is a front, and in a gap of height H the solution is exact until it reaches the other plate; for n
/// < 1 the tail is algebraic, so a gap only ever approximates it; n = 1 is the error function.
class BarenblattCouette {
 public:
  /// nu_0 [m2/s] > 0 at 1/s, exponent n > 0, plate_velocity V0 [m/s] != 0; else std::invalid_argument.
  BarenblattCouette(double nu_0, double n, double plate_velocity);

  /// v(s, t) [m/s]; V0 at s = 0. s >= 0, t >= 0.
  [[nodiscard]] double velocity(double s, double t) const;
  /// -dv/ds [1/s], of the sign of V0; t > 0.
  [[nodiscard]] double rate(double s, double t) const;
  /// Length scale [m] of the layer at time t: V0 over the plate's shear rate.
  [[nodiscard]] double thickness(double t) const;
  /// Time [s] at which the layer has this thickness.
  [[nodiscard]] double time_of_thickness(double thickness) const;
  /// Time [s] at which the front arrives at distance s; infinite for n <= 1 (there is no front).
  [[nodiscard]] double arrival(double s) const;

 private:
  [[nodiscard]] double theta(double t) const;

  double nu_0_, n_, plate_velocity_;
  double reach_;  // scale of xi: the front for n > 1, the core's width for n < 1
  double peak_;   // theta |dv/ds| at the plate
};

/// A power-law fluid with n > 1, at rest, that a body acceleration F sets in motion past a fixed wall (s =
/// 0). Away from the wall it moves with F t; the wall's layer is self-similar: u = F t [1 - f(eta)], eta =
/// s/l(t), l = (nu_0 |F|^(n-1) t^n)^(1/(n+1)), (|f'|^(n-1) f')' = f - n/(n+1) eta f', f(0) = 1, f = 0 from
/// the front on. Exact in a channel until the fronts from both walls meet.
class PowerLawStartUp {
 public:
  static constexpr double kLeastExponent = 1.05;

  /// nu_0 [m2/s] > 0 at 1/s, n >= 1.05 (kLeastExponent: nearer to 1 the series that serves here converges too
  /// slowly), body_acceleration F [m/s2] != 0; else std::invalid_argument.
  PowerLawStartUp(double nu_0, double n, double body_acceleration);

  /// u(s, t) [m/s], s >= 0, t >= 0.
  [[nodiscard]] double velocity(double s, double t) const;
  /// du/ds [1/s].
  [[nodiscard]] double gradient(double s, double t) const;
  /// Time [s] at which the front is at distance s from the wall.
  [[nodiscard]] double arrival(double s) const;

 private:
  struct Profile {
    double slope;  // -f'(eta)
    double value;  // f(eta)
  };
  [[nodiscard]] double length(double t) const;
  [[nodiscard]] Profile profile(double eta) const;

  double nu_0_, n_, body_acceleration_;
  double front_;        // eta of the front
  double slope_scale_;  // -f' over the p of the profile with its front at 1
  std::vector<double> v_,
      r_;  // power series of p^(n-1) and f/p in the distance d = 1 - eta/front, from d^1 on
};

}  // namespace reference
