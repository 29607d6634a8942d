#pragma once

#include "reference/channel/channel_solution.hpp"
#include "reference/fluids/flow_curve.hpp"

namespace reference {

/// Steady flow of the ideal Herschel-Bulkley fluid, tau = tau_y + nu_0 w^n where it flows, between plates at
/// y = 0 (at rest) and y = H (moving with V0) under a body acceleration F: the closed form (Bird, Dai &
/// Yarusso 1983, Rev. Chem. Eng. 1, 1). The stress is tau_0 - F y, the rate [(|tau| - tau_y)/nu_0]^(1/n)
/// beyond the yield stress, and the velocity the difference of n/(n+1) nu_0^(-1/n) (|tau| -
/// tau_y)_+^(1+1/n)/F between the wall and y. Where |tau| <= tau_y a plug moves as a solid; it may fill the
/// gap. SI units; time is ignored.
class IdealYieldChannel final : public ChannelSolution {
 public:
  /// `curve`'s m is ignored. Throws std::invalid_argument for H <= 0, a drive that is not finite, or none.
  IdealYieldChannel(double height, double body_acceleration, double plate_velocity,
                    const HerschelBulkleyCurve& curve);

  [[nodiscard]] double velocity(double y, double t = 0.0) const override;
  [[nodiscard]] double gradient(double y, double t = 0.0) const override;
  /// tau(y) over density, signed as du/dy [m2/s2]. In a gap that does not flow it is not determined; the one
  /// given is then the symmetric one.
  [[nodiscard]] double stress(double y) const { return wall_stress_ - body_acceleration_ * y; }
  /// Edges of the plug [m], lower <= upper; both 0 where there is none (Couette flow: no stress at or below
  /// tau_y).
  [[nodiscard]] double plug_begin() const;
  [[nodiscard]] double plug_end() const;
  /// Whether nothing moves.
  [[nodiscard]] bool at_rest() const {
    return plate_velocity_ == 0.0 && plug_begin() == 0.0 && plug_end() == height_;
  }
  /// Largest |u| [m/s]; 0 at rest.
  [[nodiscard]] double steady_maximum() const override;
  [[nodiscard]] double stated_error() const override { return 1e-14; }
  [[nodiscard]] std::string description() const override;

 private:
  /// Integral of the rate over stresses from 0 to tau, |tau| counted [m2/s3].
  [[nodiscard]] double potential(double tau) const;
  [[nodiscard]] double reached(double wall_stress, double y) const;
  [[nodiscard]] double find_wall_stress() const;

  double height_, body_acceleration_, plate_velocity_;
  HerschelBulkleyCurve curve_;
  double wall_stress_;
};

}  // namespace reference
