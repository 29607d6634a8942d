#include "verification/flows/channel/oscillating_channel_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verification/flows/layer.hpp"

namespace verification {
namespace {

double angular(double frequency) {
  return 2 * std::numbers::pi * frequency;
}

class OscillatingField final : public ExactField {
 public:
  OscillatingField(int axis, double height, std::shared_ptr<const reference::OscillatingChannel> channel)
      : axis_(axis), height_(height), channel_(std::move(channel)) {}
  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location) const override {
    // A sample on a plate may lie beyond it in the last bit.
    return channel_->velocity(std::clamp(x[1 - axis_], 0.0, height_), t) * unit(axis_);
  }
  [[nodiscard]] std::string description() const override {
    return fmt::format("periodic state of an oscillating channel, Womersley number {:.4g}, closed form",
                       channel_->womersley_number());
  }

 private:
  int axis_;
  double height_;
  std::shared_ptr<const reference::OscillatingChannel> channel_;
};

}  // namespace

OscillatingChannelFlow::OscillatingChannelFlow(const OscillatingChannelFlowParameters& parameters)
    : parameters_(parameters),
      solution_(std::make_shared<reference::OscillatingChannel>(reference::OscillatingChannelParameters{
          parameters.height, parameters.kinematic_viscosity, angular(parameters.frequency),
          parameters.body_acceleration, parameters.plate_velocity})) {}

mpm::Scene OscillatingChannelFlow::scene(const Discretisation& d) const {
  const int along = parameters_.axis, across = 1 - along;
  const double omega = angular(parameters_.frequency);
  mpm::Scene scene = layer(parameters_.height, along, d);
  const Vec2 plate = parameters_.plate_velocity * unit(along);
  mpm::Side moving;
  moving.periodic = false;
  moving.velocity = [=](double t) -> Vec2 { return std::cos(omega * t) * plate; };
  moving.acceleration = [=](double t) -> Vec2 { return -omega * std::sin(omega * t) * plate; };
  scene.side(first_edge(across)) = mpm::Side::wall(Vec2::Zero());
  scene.side(last_edge(across)) = moving;
  const Vec2 force = parameters_.body_acceleration * unit(along);
  scene.body_acceleration = [=](double t) -> Vec2 { return std::cos(omega * t) * force; };
  scene.initial_velocity = [field = exact({})](const Vec2& x) {
    return field->velocity(x, 0, Location::Particles);
  };
  scene.fluid = parameters_.fluid;
  return scene;
}

std::shared_ptr<const ExactField> OscillatingChannelFlow::exact(const std::vector<double>&) const {
  return std::make_shared<OscillatingField>(parameters_.axis, parameters_.height, solution_);
}

double OscillatingChannelFlow::velocity_scale() const {
  if (parameters_.plate_velocity != 0) return std::abs(parameters_.plate_velocity);
  return std::abs(solution_->amplitude(0.5 * parameters_.height));
}

std::optional<Oscillation> OscillatingChannelFlow::oscillation() const {
  return Oscillation{angular(parameters_.frequency), 0};
}

Probe OscillatingChannelFlow::probe() const {
  return {0.5 * parameters_.height * unit(across()), unit(parameters_.axis)};
}

}  // namespace verification
