#pragma once

#include "reference/channel/oscillating_channel.hpp"
#include "verification/flows/flow.hpp"

namespace verification {

/// A plane channel driven periodically, from its periodic state at t = 0: by a body acceleration
/// F cos(2 pi f t) (plane Womersley flow), or by the plate at H that moves with V0 cos(2 pi f t) (Stokes'
/// second problem in a gap). Newtonian.
struct OscillatingChannelFlowParameters {
  double height = 0;               ///< H [m]
  int axis = 0;                    ///< direction of flow, 0 for x, 1 for y
  double frequency = 0;            ///< f [Hz]
  double body_acceleration = 0;    ///< F [m/s2]
  double plate_velocity = 0;       ///< V0 [m/s]
  double kinematic_viscosity = 0;  ///< nu [m2/s]
  mpm::Fluid fluid;
};

class OscillatingChannelFlow final : public Flow {
 public:
  explicit OscillatingChannelFlow(const OscillatingChannelFlowParameters& parameters);
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  /// V0, or the amplitude at mid-height that F drives.
  [[nodiscard]] double velocity_scale() const override;
  [[nodiscard]] std::optional<Oscillation> oscillation() const override;
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return 1 - parameters_.axis; }
  [[nodiscard]] double length() const override { return parameters_.height; }

 private:
  OscillatingChannelFlowParameters parameters_;
  std::shared_ptr<const reference::OscillatingChannel> solution_;
};

}  // namespace verification
