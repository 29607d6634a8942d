#include "verification/flows/channel/channel_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/channel/cessation_bound.hpp"
#include "reference/channel/discrete_usf_channel.hpp"
#include "reference/channel/steady_channel.hpp"
#include "reference/transient/transient_channel.hpp"
#include "verification/flows/layer.hpp"
#include "verification/flows/reference_store.hpp"

namespace verification {
namespace {

class ContinuousChannel final : public ExactField {
 public:
  ContinuousChannel(int axis, std::shared_ptr<const reference::ChannelSolution> solution)
      : axis_(axis), solution_(std::move(solution)) {}
  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location) const override {
    return solution_->velocity(x[1 - axis_], t) * unit(axis_);
  }
  [[nodiscard]] std::optional<double> shear_rate(const Vec2& x, double t) const override {
    return std::abs(solution_->gradient(x[1 - axis_], t));
  }
  [[nodiscard]] std::string description() const override { return solution_->description(); }

 private:
  int axis_;
  std::shared_ptr<const reference::ChannelSolution> solution_;
};

/// Node and row values of the discrete solution; between nodes the linear basis interpolates.
class DiscreteChannel final : public ExactField {
 public:
  DiscreteChannel(int axis, const reference::DiscreteUsfChannelParameters& parameters)
      : axis_(axis), parameters_(parameters), channel_(parameters) {}

  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location location) const override {
    const double y = x[1 - axis_];
    const long step = std::lround(t / parameters_.time_step);
    if (step != step_) {
      step_ = step;
      nodes_ = channel_.node_velocity(step);
      rows_ = channel_.particle_velocity(step);
    }
    if (location == Location::Particles) {
      const double rows_per_metre = static_cast<double>(rows_.size()) / parameters_.height;
      return rows_.at(static_cast<std::size_t>(y * rows_per_metre)) * unit(axis_);
    }
    const double s = y * parameters_.cells / parameters_.height;
    const auto j = static_cast<std::size_t>(std::clamp(std::floor(s + 1e-9), 0.0, parameters_.cells - 1.0));
    const double xi = s - static_cast<double>(j);
    return ((1 - xi) * nodes_[j] + xi * nodes_[j + 1]) * unit(axis_);
  }

  [[nodiscard]] std::string description() const override {
    return "exact discrete solution of the Newtonian USF linear FLIP scheme";
  }

 private:
  int axis_;
  reference::DiscreteUsfChannelParameters parameters_;
  reference::DiscreteUsfChannel channel_;
  mutable long step_ =
      -1;  // the step whose values are held: every sample of one output time asks for the same
  mutable std::vector<double> nodes_, rows_;
};

/// Steady nodal values of the linear scheme; particles have none.
class SteadyNodes final : public ExactField {
 public:
  SteadyNodes(int axis, double height, std::vector<double> nodes)
      : axis_(axis), height_(height), nodes_(std::move(nodes)) {}
  [[nodiscard]] Vec2 velocity(const Vec2& x, double, Location location) const override {
    const double s = x[1 - axis_] / height_ * static_cast<double>(nodes_.size() - 1);
    const double j = std::round(s);
    // 1e-6 of a cell: corners are computed, anything else is not a node.
    if (location == Location::Particles || std::abs(s - j) > 1e-6)
      return Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    return nodes_.at(static_cast<std::size_t>(j)) * unit(axis_);
  }
  [[nodiscard]] std::string description() const override { return "exact steady nodes of the linear scheme"; }

 private:
  int axis_;
  double height_;
  std::vector<double> nodes_;
};

}  // namespace

std::shared_ptr<const ExactField> channel_field(int axis,
                                                std::shared_ptr<const reference::ChannelSolution> solution) {
  return std::make_shared<ContinuousChannel>(axis, std::move(solution));
}

std::shared_ptr<const ExactField> steady_nodes_field(int axis, double height, std::vector<double> nodes) {
  return std::make_shared<SteadyNodes>(axis, height, std::move(nodes));
}

ChannelFlow::ChannelFlow(const ChannelParameters& parameters) : parameters_(parameters) {
  const SteadyScales scales = steady_scales(problem({}));
  steady_maximum_ = scales.maximum;
  steady_mid_height_ = scales.mid_height;
}

mpm::Scene ChannelFlow::scene(const Discretisation& d) const {
  const int along = parameters_.axis, across = 1 - along;
  mpm::Scene scene = layer(parameters_.height, along, d);
  if (parameters_.length > 0) scene.size[along] = parameters_.length;
  scene.side(first_edge(across)) = mpm::Side::wall(Vec2::Zero());
  scene.side(last_edge(across)) = mpm::Side::wall(parameters_.plate_velocity * unit(along));
  const Vec2 b = parameters_.body_acceleration * unit(along);
  scene.body_acceleration = [b](double) { return b; };
  scene.fluid = parameters_.fluid.solver;
  if (parameters_.initial_acceleration != 0) {
    const reference::SteadyChannel before(parameters_.height, parameters_.initial_acceleration, 0,
                                          parameters_.fluid.curve);
    scene.initial_velocity = [before, along, across](const Vec2& x) {
      return before.velocity(x[across]) * unit(along);
    };
  }
  return scene;
}

std::shared_ptr<const ExactField> ChannelFlow::exact(const std::vector<double>& times) const {
  return std::make_shared<ContinuousChannel>(parameters_.axis, channel_solution(problem(times)));
}

std::optional<CostlyReference> ChannelFlow::costly_reference(const std::vector<double>& times) const {
  if (parameters_.fluid.curve.newtonian()) return std::nullopt;  // a series
  const reference::ChannelProblem asked = problem(times);
  return CostlyReference{reference::transient_name(asked), asked.last_time()};
}

reference::ChannelProblem ChannelFlow::problem(const std::vector<double>& times) const {
  return {parameters_.height,
          parameters_.body_acceleration,
          parameters_.plate_velocity,
          parameters_.fluid.curve,
          times,
          parameters_.initial_acceleration};
}

bool ChannelFlow::has_ideal() const {
  return parameters_.fluid.curve.yielding() &&
         (parameters_.body_acceleration != 0 || parameters_.plate_velocity != 0);
}

reference::IdealYieldChannel ChannelFlow::ideal_channel() const {
  return {parameters_.height, parameters_.body_acceleration, parameters_.plate_velocity,
          *parameters_.fluid.curve.yielding()};
}

std::shared_ptr<const ExactField> ChannelFlow::ideal() const {
  if (!has_ideal()) return nullptr;
  return std::make_shared<ContinuousChannel>(parameters_.axis,
                                             std::make_shared<reference::IdealYieldChannel>(ideal_channel()));
}

std::optional<std::pair<double, double>> ChannelFlow::ideal_plug() const {
  if (!has_ideal()) return std::nullopt;
  const reference::IdealYieldChannel channel = ideal_channel();
  if (!(channel.plug_end() > channel.plug_begin())) return std::nullopt;
  return std::pair{channel.plug_begin(), channel.plug_end()};
}

double ChannelFlow::speed_bound(double initial_speed, double t) const {
  const auto* curve = parameters_.fluid.curve.yielding();
  if (!curve || parameters_.body_acceleration != 0 || parameters_.plate_velocity != 0)
    return std::numeric_limits<double>::quiet_NaN();
  return reference::CessationBound(parameters_.height, *curve).speed(initial_speed, t);
}

std::shared_ptr<const ExactField> ChannelFlow::exact_discrete(const Discretisation& d, double dt) const {
  const auto nu = parameters_.fluid.curve.newtonian();
  if (!nu || parameters_.initial_acceleration != 0) return nullptr;
  return std::make_shared<DiscreteChannel>(
      parameters_.axis,
      reference::DiscreteUsfChannelParameters{parameters_.height, d.cells, d.particles_across, *nu,
                                              parameters_.body_acceleration, parameters_.plate_velocity, dt});
}

std::shared_ptr<const ExactField> ChannelFlow::steady_nodes(const Discretisation& d) const {
  if (parameters_.plate_velocity != 0 || parameters_.body_acceleration == 0) return nullptr;
  const reference::SteadyChannel steady(parameters_.height, parameters_.body_acceleration, 0,
                                        parameters_.fluid.curve);
  return std::make_shared<SteadyNodes>(parameters_.axis, parameters_.height,
                                       steady.linear_scheme_nodes(d.cells));
}

Probe ChannelFlow::probe() const {
  return {0.5 * parameters_.height * unit(across()), unit(parameters_.axis)};
}

double ChannelFlow::bias_unit(double h) const {
  const auto nu = parameters_.fluid.curve.newtonian();
  return nu ? h * h * parameters_.body_acceleration / *nu : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace verification
