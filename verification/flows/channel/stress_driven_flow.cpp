#include "verification/flows/channel/stress_driven_flow.hpp"

#include <cmath>
#include <limits>

#include "reference/channel/traction/stress_driven_channel.hpp"
#include "reference/transient/transient_channel.hpp"
#include "verification/flows/channel/channel_flow.hpp"
#include "verification/flows/layer.hpp"
#include "verification/flows/reference_store.hpp"

namespace verification {
namespace {

class StressDrivenField final : public ExactField {
 public:
  StressDrivenField(int axis, const reference::StressDrivenChannel& channel)
      : axis_(axis), channel_(channel) {}
  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location) const override {
    return channel_.velocity(x[1 - axis_], t) * unit(axis_);
  }
  [[nodiscard]] std::optional<double> shear_rate(const Vec2& x, double t) const override {
    return std::abs(channel_.gradient(x[1 - axis_], t));
  }
  [[nodiscard]] std::string description() const override { return channel_.description(); }

 private:
  int axis_;
  reference::StressDrivenChannel channel_;
};

}  // namespace

StressDrivenFlow::StressDrivenFlow(const StressDrivenFlowParameters& parameters)
    : parameters_(parameters),
      rate_(std::copysign(
          parameters.fluid.curve.rate(std::abs(parameters.stress) / parameters.fluid.solver.density),
          parameters.stress)) {}

mpm::Scene StressDrivenFlow::scene(const Discretisation& d) const {
  const int along = parameters_.axis, across = 1 - along;
  mpm::Scene scene = layer(parameters_.height, along, d);
  scene.side(first_edge(across)) = mpm::Side::wall(Vec2::Zero());
  scene.side(last_edge(across)) = mpm::Side::pulled(parameters_.stress);
  scene.fluid = parameters_.fluid.solver;
  return scene;
}

std::optional<CostlyReference> StressDrivenFlow::costly_reference(const std::vector<double>& times) const {
  if (parameters_.fluid.curve.newtonian()) return std::nullopt;  // a series
  const reference::ChannelProblem asked = problem(times);
  return CostlyReference{reference::transient_name(asked), asked.last_time()};
}

reference::ChannelProblem StressDrivenFlow::problem(const std::vector<double>& times) const {
  return {parameters_.height,
          0,
          0,
          parameters_.fluid.curve,
          times,
          0,
          parameters_.stress / parameters_.fluid.solver.density};
}

std::shared_ptr<const ExactField> StressDrivenFlow::exact(const std::vector<double>& times) const {
  const auto nu = parameters_.fluid.curve.newtonian();
  if (!nu) return channel_field(parameters_.axis, channel_solution(problem(times)));
  return std::make_shared<StressDrivenField>(
      parameters_.axis, reference::StressDrivenChannel(
                            parameters_.height, *nu, parameters_.stress / parameters_.fluid.solver.density));
}

std::shared_ptr<const ExactField> StressDrivenFlow::steady_nodes(const Discretisation& d) const {
  std::vector<double> nodes;
  for (int j = 0; j <= d.cells; ++j) nodes.push_back(rate_ * parameters_.height * j / d.cells);
  return steady_nodes_field(parameters_.axis, parameters_.height, std::move(nodes));
}

/// At the side that is pulled: nothing else decides its velocity.
Probe StressDrivenFlow::probe() const {
  return {parameters_.height * unit(across()), unit(parameters_.axis)};
}

}  // namespace verification
