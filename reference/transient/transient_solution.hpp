#pragma once

#include <optional>

#include "reference/channel/channel_problem.hpp"
#include "reference/channel/power_law_exact.hpp"
#include "reference/channel/steady_channel.hpp"
#include "reference/transient/gradient_history.hpp"

namespace reference {

/// How finely a transient is computed.
struct TransientResolution {
  int degree = 0;          ///< of the spectral elements
  double tolerance = 0.0;  ///< of integrate_shear
  double smallest =
      0.0;  ///< element next to the centre or the wall away from the start's layer, over the line's length
  double neglected = 0.0;  ///< share of the displacement that the first layer may leave out
};

/// Coarse and fine resolution that suit a problem; every number of the fine one is finer, so that their
/// difference shows every error.
TransientResolution coarse_resolution(const ChannelProblem& problem);
TransientResolution fine_resolution(const ChannelProblem& problem);

/// One computed start-up: which coordinate it lives in, how it begins, and the history of its gradient from
/// there on.
///
/// - Plates at rest: s = y on the lower half of the gap, zero stress in the middle. It begins at rest, or
/// steady under the problem's initial acceleration; with a power law of
///   n >= 1.05 at the moment when the fronts meet, up to which PowerLawStartUp is exact.
/// - Upper plate moving: s = H - y on the whole gap. It begins as BarenblattCouette's layer under the power
/// law that osculates
///   the flow curve at the layer's shear rate, so thin that what it neglects - the curve's bending, the other
///   plate, the body force - is a negligible share of the displacement; for power-law Couette with n > 1 at
///   the moment when the front lands.
/// - Upper side pulled: s = y on the whole gap, the rate that has the stress at the far end. It begins at
/// rest.
class TransientSolution {
 public:
  /// Sets up the problem without solving it; `problem` has passed its check.
  TransientSolution(const ChannelProblem& problem, const TransientResolution& resolution);

  /// Computes the history up to the last of the problem's times.
  void solve();
  /// Takes over snapshots computed before with the same resolution for the same flow, accurate from the same
  /// time and at least as long: what this problem's own solve() would have computed. False, and nothing
  /// taken, if they do not fit or do not reach far enough.
  bool adopt(const std::vector<GradientHistory::Snapshot>& snapshots);
  /// What solve computed: empty if all times lie in the exact beginning.
  [[nodiscard]] std::vector<GradientHistory::Snapshot> snapshots() const;

  /// u(y, t) [m/s] and du/dy [1/s], 0 <= y <= H, 0 <= t <= last time.
  [[nodiscard]] double velocity(double y, double t) const;
  [[nodiscard]] double gradient(double y, double t) const;

 private:
  void choose_layer();
  [[nodiscard]] SpectralLine mesh() const;
  [[nodiscard]] std::vector<double> start(const SpectralLine& line) const;
  [[nodiscard]] bool whole_gap() const { return problem_.plate_velocity != 0.0; }
  [[nodiscard]] bool pulled() const { return problem_.pull != 0.0; }
  [[nodiscard]] bool combined() const { return whole_gap() && problem_.body_acceleration != 0.0; }

  ChannelProblem problem_;
  TransientResolution resolution_;
  SteadyChannel before_;  // t = 0
  double velocity_scale_ = 0.0;
  bool thinning_ = false;  // tangent viscosity larger at rest than at the flow's own shear rates
  double start_time_ = 0.0;
  std::optional<BarenblattCouette> layer_;   // exact or asymptotic up to start_time_
  std::optional<PowerLawStartUp> start_up_;  // exact up to start_time_
  double far_rate_ = 0.0;                    // at the far end, where it is given [1/s]
  bool fronts_arrived_ = false;              // start_time_ is that of a front's arrival at the far end
  std::optional<GradientHistory> history_;
};

}  // namespace reference
