#include "verification/flows/vortices/lid_driven_cavity_flow.hpp"

#include <cmath>
#include <limits>

#include "reference/vortices/lid_driven_cavity.hpp"

namespace verification {
namespace {

/// The tables' values where they stand, NaN elsewhere and for the other component.
class TabulatedField final : public ExactField {
 public:
  TabulatedField(std::vector<reference::CavityPoint> points, double side, double lid_velocity)
      : points_(std::move(points)), side_(side), lid_velocity_(lid_velocity) {}

  [[nodiscard]] Vec2 velocity(const Vec2& x, double, Location location) const override {
    Vec2 v = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    if (location != Location::Grid) return v;
    for (const reference::CavityPoint& point : points_)
      if (std::hypot(x.x() / side_ - point.x, x.y() / side_ - point.y) < 1e-9)
        v[point.component] = lid_velocity_ * point.value;
    return v;
  }
  [[nodiscard]] std::string description() const override {
    return "steady state: the tables of Marchi, Suero & Araki 2009, six digits";
  }

 private:
  std::vector<reference::CavityPoint> points_;
  double side_, lid_velocity_;
};

}  // namespace

mpm::Scene LidDrivenCavityFlow::scene(const Discretisation& d) const {
  mpm::Scene scene;
  scene.size = Vec2::Constant(parameters_.side);
  scene.cells = {d.cells, d.cells};
  scene.particles_per_cell = {d.particles_along, d.particles_across};
  for (mpm::Side& side : scene.sides) side = mpm::Side::wall(Vec2::Zero());
  scene.side(mpm::Edge::Top) = mpm::Side::wall(Vec2(parameters_.lid_velocity, 0));
  scene.fluid = parameters_.fluid;
  return scene;
}

bool LidDrivenCavityFlow::has_exact() const {
  return !reference::marchi_2009(reynolds()).empty();
}

std::shared_ptr<const ExactField> LidDrivenCavityFlow::exact(const std::vector<double>&) const {
  if (!has_exact()) return nullptr;
  return std::make_shared<TabulatedField>(reference::marchi_2009(reynolds()), parameters_.side,
                                          parameters_.lid_velocity);
}

mpm::VectorField LidDrivenCavityFlow::tabulated_points() const {
  mpm::VectorField points;
  for (const reference::CavityPoint& point : reference::marchi_2009(reynolds()))
    points.emplace_back(parameters_.side * point.x, parameters_.side * point.y);
  return points;
}

}  // namespace verification
