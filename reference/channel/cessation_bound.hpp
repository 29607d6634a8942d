#pragma once

#include "reference/fluids/flow_curve.hpp"

namespace reference {

/// How fast a fluid with a yield stress can still move between plates at rest, a gap H apart, when nothing
/// drives it any more. For u the root mean square velocity over the gap, the energy balance with |u'| >=
/// (pi/H) |u| in the mean square, with the mean of |u'| >= 2 u/H, and with w exp(-m w) <= 1/(e m) for the
/// regularisation, gives
///   du/dt <= - a u - b + c/u,   a = nu pi^2/H^2 (n = 1; 0 for other n), b = 2 tau_y/H, c = tau_y/(e m).
/// The ideal Bingham fluid (c = 0) stops in finite time, by ln(1 + a u_0/b)/a (Glowinski 1984, Numerical
/// Methods for Nonlinear Variational Problems; Huilgol, Mena & Piau 2002, J. Non-Newtonian Fluid Mech. 102,
/// 97), any other n by u_0/b; the regularised one comes down to a creep of about H/(2 e m). SI units.
class CessationBound {
 public:
  /// Throws std::invalid_argument for H <= 0.
  CessationBound(double height, const HerschelBulkleyCurve& curve);

  /// Time [s] by which the ideal fluid has stopped, from a root mean square velocity u_0 [m/s] >= 0.
  [[nodiscard]] double stopping_time(double u_0) const;
  /// Largest root mean square velocity [m/s] of the regularised fluid at time t [s] >= 0.
  [[nodiscard]] double speed(double u_0, double t) const;

 private:
  /// Time in which the bound falls from u_0 to u, both above its resting value.
  [[nodiscard]] double time_between(double u_0, double u) const;

  double a_, b_, c_;
  double rest_;  // where the bound comes to rest: a u^2 + b u = c
};

}  // namespace reference
