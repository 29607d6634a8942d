#include "verification/flows/waves/dilatation_flow.hpp"

#include <limits>

#include "verification/flows/layer.hpp"

namespace verification {
namespace {

class DilatationField final : public ExactField {
 public:
  DilatationField(int axis, double length, std::shared_ptr<const reference::UniformDilatation> flow)
      : axis_(axis), length_(length), flow_(std::move(flow)) {}
  /// NaN at grid samples that the fluid has left.
  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location location) const override {
    if (location == Location::Grid && x[axis_] > length_ * flow_->stretch(t))
      return Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    return flow_->velocity(x[axis_], t) * unit(axis_);
  }
  [[nodiscard]] std::optional<double> density(const Vec2&, double t) const override {
    return flow_->density(t);
  }
  [[nodiscard]] std::optional<Vec2> path(const Vec2& start, double t) const override {
    Vec2 x = start;
    x[axis_] *= flow_->stretch(t);
    return x;
  }
  [[nodiscard]] std::string description() const override { return "even dilatation in free flight"; }

 private:
  int axis_;
  double length_;  // at t = 0 [m]
  std::shared_ptr<const reference::UniformDilatation> flow_;
};

}  // namespace

DilatationFlow::DilatationFlow(const DilatationFlowParameters& parameters)
    : parameters_(parameters),
      solution_(std::make_shared<reference::UniformDilatation>(
          reference::UniformDilatationParameters{parameters.rate, parameters.fluid.density})) {}

mpm::Scene DilatationFlow::scene(const Discretisation& d) const {
  const int across = parameters_.axis, along = 1 - across;
  mpm::Scene scene = layer(parameters_.length, along, d);
  const auto wall_at = [&](double x) {
    mpm::Side wall;
    wall.periodic = false;
    wall.velocity = [=, flow = solution_](double t) -> Vec2 { return flow->velocity(x, t) * unit(across); };
    // Of the fluid that is there, not of the place: nodal accelerations follow the material, which flies
    // free.
    wall.acceleration = [](double) -> Vec2 { return Vec2::Zero(); };
    return wall;
  };
  scene.side(across == 0 ? mpm::Edge::Left : mpm::Edge::Bottom) = wall_at(0);
  scene.side(across == 0 ? mpm::Edge::Right : mpm::Edge::Top) = wall_at(parameters_.length);
  scene.initial_velocity = [across, flow = solution_](const Vec2& x) -> Vec2 {
    return flow->velocity(x[across], 0) * unit(across);
  };
  scene.fluid = parameters_.fluid;
  return scene;
}

std::shared_ptr<const ExactField> DilatationFlow::exact(const std::vector<double>&) const {
  return std::make_shared<DilatationField>(parameters_.axis, parameters_.length, solution_);
}

Probe DilatationFlow::probe() const {
  return {0.25 * parameters_.length * unit(parameters_.axis), unit(parameters_.axis)};
}

}  // namespace verification
