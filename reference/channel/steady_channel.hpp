#pragma once

#include <vector>

#include "reference/fluids/flow_curve.hpp"

namespace reference {

/// Steady flow of any fluid with a monotone flow curve between plates at y = 0 (at rest) and y = H (moving
/// with V0), driven by a body acceleration F: Poiseuille (V0 = 0), Couette (F = 0) and every combination. SI
/// units.
///
/// The stress is the straight line tau(y) = tau_0 - F y, so u(y) = [Psi(tau_0) - Psi(tau_0 - F y)]/F with Psi
/// the complementary potential w tau - Phi(w) (Bird, Armstrong & Hassager 1987, ch. 4). tau_0 = F H/2 without
/// a moving plate, else the root of u(H) = V0. Where the stress hardly varies over the gap, that difference
/// would cancel, and the integral of w(tau) is taken by Gauss quadrature instead; that of a fluid with a
/// yield stress, regularised or ideal, always is, from bend to bend (IdealYieldChannel is the closed form).
class SteadyChannel {
 public:
  /// Throws std::invalid_argument for a non-positive H, a drive that is not finite, a flow curve that is not
  /// monotone up to the largest shear rate of the flow, or one that cannot carry its stress.
  SteadyChannel(double height, double body_acceleration, double plate_velocity, const FlowCurve& curve);

  /// u(y) [m/s], 0 <= y <= H; 0 and V0 at the plates to the last bit.
  [[nodiscard]] double velocity(double y) const;
  /// du/dy [1/s].
  [[nodiscard]] double gradient(double y) const { return curve_.rate(stress(y)); }
  /// tau(y) [m2/s2], signed as du/dy.
  [[nodiscard]] double stress(double y) const;
  /// u(H/2) [m/s].
  [[nodiscard]] double mid_height_velocity() const { return velocity(0.5 * height_); }
  /// Largest |u| [m/s], inside the gap or at the moving plate.
  [[nodiscard]] double maximum() const;
  /// Largest |du/dy| [1/s]: it is at one of the plates.
  [[nodiscard]] double largest_rate() const;

  /// Steady nodal velocities of the linear-basis scheme on `cells` equal cells, size cells + 1, for V0 = 0:
  /// u_{j+1} - u_j = h w(F (H/2 - y_{j+1/2})), y_{j+1/2} the middle of cell j. Throws std::invalid_argument
  /// for cells < 1 or V0 != 0.
  [[nodiscard]] std::vector<double> linear_scheme_nodes(int cells) const;

 private:
  [[nodiscard]] double integrated_rate(double wall_stress, double y) const;
  [[nodiscard]] double find_wall_stress() const;

  double height_, body_acceleration_, plate_velocity_;
  FlowCurve curve_;
  double wall_stress_;  // tau at y = 0
};

}  // namespace reference
