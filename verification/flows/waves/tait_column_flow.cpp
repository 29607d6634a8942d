#include "verification/flows/waves/tait_column_flow.hpp"

#include <fmt/format.h>

#include "verification/flows/layer.hpp"

namespace verification {
namespace {

class ColumnField final : public ExactField {
 public:
  ColumnField(int axis, double gravity, std::shared_ptr<const reference::TaitColumn> column)
      : axis_(axis), gravity_(gravity), column_(std::move(column)) {}
  [[nodiscard]] Vec2 velocity(const Vec2&, double, Location) const override { return Vec2::Zero(); }
  [[nodiscard]] std::optional<double> density(const Vec2& x, double) const override {
    return column_->density(x[axis_]);
  }
  [[nodiscard]] std::optional<Vec2> path(const Vec2& start, double) const override { return start; }
  [[nodiscard]] std::string description() const override {
    return fmt::format("hydrostatic equilibrium of the Tait fluid under {:.6g} m/s2, closed form", gravity_);
  }

 private:
  int axis_;
  double gravity_;
  std::shared_ptr<const reference::TaitColumn> column_;
};

}  // namespace

TaitColumnFlow::TaitColumnFlow(const TaitColumnFlowParameters& parameters)
    : parameters_(parameters),
      gravity_(reference::TaitColumn::gravity_of_contrast(parameters.density_contrast, parameters.height,
                                                          parameters.fluid.sound_speed())),
      solution_(std::make_shared<reference::TaitColumn>(reference::TaitColumnParameters{
          parameters.height, gravity_, parameters.fluid.sound_speed(), parameters.fluid.density})) {}

mpm::Scene TaitColumnFlow::scene(const Discretisation& d) const {
  const int across = parameters_.axis, along = 1 - across;
  mpm::Scene scene = layer(parameters_.height, along, d);
  scene.side(first_edge(across)) = mpm::Side::wall(Vec2::Zero());
  scene.side(last_edge(across)) = mpm::Side::wall(Vec2::Zero());
  scene.body_acceleration = [b = Vec2(-gravity_ * unit(across))](double) { return b; };
  scene.initial_density = [across, column = solution_](const Vec2& x) { return column->density(x[across]); };
  scene.fluid = parameters_.fluid;
  return scene;
}

std::shared_ptr<const ExactField> TaitColumnFlow::exact(const std::vector<double>&) const {
  return std::make_shared<ColumnField>(parameters_.axis, gravity_, solution_);
}

Probe TaitColumnFlow::probe() const {
  return {0.5 * parameters_.height * unit(parameters_.axis), unit(parameters_.axis)};
}

}  // namespace verification
