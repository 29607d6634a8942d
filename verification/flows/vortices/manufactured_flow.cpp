#include "verification/flows/vortices/manufactured_flow.hpp"

#include <algorithm>
#include <cmath>

namespace verification {
namespace {

class ManufacturedField final : public ExactField {
 public:
  explicit ManufacturedField(std::shared_ptr<const reference::ManufacturedFlow> solution)
      : solution_(std::move(solution)) {}
  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location) const override {
    const auto v = solution_->velocity(x.x(), x.y(), t);
    return {v[0], v[1]};
  }
  [[nodiscard]] std::string description() const override {
    return "manufactured wave between plates, exact with the acceleration that drives it";
  }

 private:
  std::shared_ptr<const reference::ManufacturedFlow> solution_;
};

}  // namespace

ManufacturedFlow::ManufacturedFlow(const reference::ManufacturedParameters& parameters,
                                   const FluidConfig& fluid)
    : parameters_(parameters),
      fluid_(fluid.solver),
      solution_(std::make_shared<reference::ManufacturedFlow>(parameters)) {}

mpm::Scene ManufacturedFlow::scene(const Discretisation& d) const {
  mpm::Scene scene;
  scene.size = {parameters_.length, parameters_.height};
  scene.cells = {
      std::max(1, static_cast<int>(std::lround(d.cells * parameters_.length / parameters_.height))), d.cells};
  scene.particles_per_cell = {d.particles_along, d.particles_across};
  scene.side(mpm::Edge::Bottom) = mpm::Side::wall(Vec2::Zero());
  scene.side(mpm::Edge::Top) = mpm::Side::wall(Vec2(parameters_.plate_velocity, 0));
  scene.fluid = fluid_;
  scene.initial_velocity = [field = ManufacturedField(solution_)](const Vec2& x) {
    return field.velocity(x, 0, Location::Particles);
  };
  scene.acceleration_field = [solution = solution_](const mpm::VectorField& points, double t,
                                                    mpm::VectorField& acceleration) {
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto b = solution->acceleration(points[p].x(), points[p].y(), t);
      acceleration[p] = {b[0], b[1]};
    }
  };
  return scene;
}

std::shared_ptr<const ExactField> ManufacturedFlow::exact(const std::vector<double>&) const {
  return std::make_shared<ManufacturedField>(solution_);
}

Probe ManufacturedFlow::probe() const {
  return {Vec2(0.25 * parameters_.length, 0.25 * parameters_.height), Vec2(1, 0)};
}

}  // namespace verification
