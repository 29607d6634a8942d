#pragma once

#include <array>
#include <vector>

#include "reference/fluids/flow_curve.hpp"
#include "reference/transient/spectral_line.hpp"

namespace reference {

/// The velocity gradient w(s, t) of a channel: w_t = tau(w)_ss on [0, length], with the stress's slope given
/// at s = 0 and, at the far end, either given too (a wall) or the rate: zero at a symmetry plane, and where a
/// stress pulls the one that has it. The slope is what a steady wall under a uniform body force demands.
/// Spectral elements with lumped mass in space, the three-stage Radau IIA method (order 5, L-stable; Hairer &
/// Wanner II, IV.5) in time. Conservative: the integral of w changes by what the ends let through.
///
/// Newton works on the stress for shear-thinning curves and on w for the others, so that neither an infinite
/// nor a vanishing viscosity appears in it: in terms of q, W(q)_t = T(q)_ss with W and T both smooth.
class ShearDiffusion {
 public:
  using Stages = std::array<std::vector<double>, 3>;

  enum class Unknown { kStress, kRate };
  enum class FarEnd { kWall, kGivenRate };

  ShearDiffusion(const FlowCurve& curve, const SpectralLine& line, double stress_slope, FarEnd far_end,
                 Unknown unknown, double far_rate = 0.0);

  /// One step of length h [s] from the nodal gradients `w`. `stages` holds a first guess of w at the three
  /// stages, and on return their solution; the last is the new state. Returns false if Newton does not
  /// converge.
  bool step(double h, const std::vector<double>& w, Stages& stages) const;

  /// dw/dt at the end of that step, from its stages: free of the noise that applying the operator to w would
  /// bring in.
  [[nodiscard]] std::vector<double> rate_at_end(double h, const std::vector<double>& w,
                                                const Stages& stages) const;

  /// Weights of start and stages in the value of the collocation polynomial at `theta` steps after the step's
  /// begin.
  [[nodiscard]] static std::array<double, 4> collocation_weights(double theta);

  /// The collocation points c_1, c_2, c_3 = 1.
  static const std::array<double, 3>& points();

 private:
  class Newton;
  enum class Factorisations { kShared, kFresh };

  /// Newton's iteration from the guess in `stages`; false if it does not converge.
  bool iterate(double h, const std::vector<double>& w, Stages& stages, Factorisations factorisations) const;

  const FlowCurve& curve_;
  const SpectralLine& line_;
  double stress_slope_;
  FarEnd far_end_;
  Unknown unknown_;
  double far_rate_;                // of FarEnd::kGivenRate [1/s]
  std::vector<double> stiffness_;  // of the reference element, (p+1)^2
};

}  // namespace reference
