#pragma once

#include "reference/channel/channel_problem.hpp"
#include "reference/channel/channel_solution.hpp"
#include "reference/channel/ideal_yield_channel.hpp"
#include "verification/flows/flow.hpp"
#include "verification/flows/fluid_reader.hpp"

namespace verification {

/// A plane channel: fluid between a plate at rest at 0 and a plate at H that moves with V0 from t = 0, driven
/// by a body acceleration F along the plates, from rest. Poiseuille is V0 = 0, Couette F = 0. Cessation is V0
/// = F = 0 after a steady flow.
struct ChannelParameters {
  double height = 0;                ///< H [m]
  double length = 0;                ///< L along the plates [m]; 0: square cells
  int axis = 0;                     ///< direction of flow, 0 for x, 1 for y
  double body_acceleration = 0;     ///< F [m/s2]
  double plate_velocity = 0;        ///< V0 [m/s]
  double initial_acceleration = 0;  ///< F before t = 0, whose steady flow is the start [m/s2]; 0: from rest
  FluidConfig fluid;
};

/// A channel's solution as what runs along an axis are compared with.
std::shared_ptr<const ExactField> channel_field(int axis,
                                                std::shared_ptr<const reference::ChannelSolution> solution);
/// Steady nodal values of the linear scheme, from the resting plate up; particles and other points have none.
std::shared_ptr<const ExactField> steady_nodes_field(int axis, double height, std::vector<double> nodes);

class ChannelFlow final : public Flow {
 public:
  /// Throws std::invalid_argument for a drive or a flow curve that no steady flow exists for.
  explicit ChannelFlow(const ChannelParameters& parameters);

  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  [[nodiscard]] std::optional<CostlyReference> costly_reference(
      const std::vector<double>& times) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact_discrete(const Discretisation& discretisation,
                                                                 double dt) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> steady_nodes(
      const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> ideal() const override;
  [[nodiscard]] std::optional<std::pair<double, double>> ideal_plug() const override;
  [[nodiscard]] double speed_bound(double initial_speed, double t) const override;
  [[nodiscard]] double velocity_scale() const override { return steady_maximum_; }
  [[nodiscard]] bool has_shear_profile() const override { return true; }
  [[nodiscard]] double steady_probe() const override { return steady_mid_height_; }
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return 1 - parameters_.axis; }
  [[nodiscard]] double length() const override { return parameters_.height; }
  [[nodiscard]] double bias_unit(double cell_size) const override;

 private:
  [[nodiscard]] bool has_ideal() const;
  [[nodiscard]] reference::IdealYieldChannel ideal_channel() const;
  [[nodiscard]] reference::ChannelProblem problem(const std::vector<double>& times) const;

  ChannelParameters parameters_;
  double steady_maximum_, steady_mid_height_;  // [m/s]
};

}  // namespace verification
