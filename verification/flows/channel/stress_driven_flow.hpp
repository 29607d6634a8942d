#pragma once

#include "reference/channel/channel_problem.hpp"
#include "verification/flows/flow.hpp"
#include "verification/flows/fluid_reader.hpp"

namespace verification {

/// A plane channel whose side at H is pulled along itself by a stress from t = 0 (the boundary traction of
/// Zhou & Sun 2019, Eq. 17), above a plate at rest. Exact start-up for a Newtonian fluid, a
/// computed one for others; the steady state is u = w y with the rate w that has the stress.
struct StressDrivenFlowParameters {
  double height = 0;  ///< H [m]
  int axis = 0;       ///< direction of flow, 0 for x, 1 for y
  double stress = 0;  ///< [Pa], not zero
  FluidConfig fluid;
};

class StressDrivenFlow final : public Flow {
 public:
  /// Throws std::invalid_argument for a stress that the fluid does not reach at any rate.
  explicit StressDrivenFlow(const StressDrivenFlowParameters& parameters);
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  /// Linear, as the fluid is: u = w y.
  [[nodiscard]] std::shared_ptr<const ExactField> steady_nodes(
      const Discretisation& discretisation) const override;
  [[nodiscard]] std::optional<CostlyReference> costly_reference(
      const std::vector<double>& times) const override;
  [[nodiscard]] double velocity_scale() const override { return std::abs(rate_) * parameters_.height; }
  [[nodiscard]] bool has_shear_profile() const override { return true; }
  [[nodiscard]] double steady_probe() const override { return rate_ * parameters_.height; }
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return 1 - parameters_.axis; }
  [[nodiscard]] double length() const override { return parameters_.height; }

 private:
  [[nodiscard]] reference::ChannelProblem problem(const std::vector<double>& times) const;

  StressDrivenFlowParameters parameters_;
  double rate_;  // steady [1/s]
};

}  // namespace verification
