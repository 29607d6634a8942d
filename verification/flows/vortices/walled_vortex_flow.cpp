#include "verification/flows/vortices/walled_vortex_flow.hpp"

namespace verification {
namespace {

class WalledVortexField final : public ExactField {
 public:
  WalledVortexField(std::shared_ptr<const reference::WalledVortex> solution, double mass)
      : solution_(std::move(solution)), mass_(mass) {}
  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location) const override {
    const auto v = solution_->velocity(x.x(), x.y(), t);
    return {v[0], v[1]};
  }
  [[nodiscard]] std::optional<double> pressure(const Vec2&, double) const override { return 0; }
  [[nodiscard]] std::optional<double> kinetic_energy(double t) const override {
    const double speed = solution_->rms_speed(t);
    return 0.5 * mass_ * speed * speed;
  }
  [[nodiscard]] std::string description() const override {
    return "manufactured vortex between walls, exact with the acceleration that drives it";
  }

 private:
  std::shared_ptr<const reference::WalledVortex> solution_;
  double mass_;  // [kg/m]
};

}  // namespace

WalledVortexFlow::WalledVortexFlow(const reference::WalledVortexParameters& parameters,
                                   const mpm::Fluid& fluid)
    : parameters_(parameters),
      fluid_(fluid),
      solution_(std::make_shared<reference::WalledVortex>(parameters)) {}

mpm::Scene WalledVortexFlow::scene(const Discretisation& d) const {
  mpm::Scene scene;
  scene.size = Vec2::Constant(parameters_.side);
  scene.cells = {d.cells, d.cells};
  scene.particles_per_cell = {d.particles_along, d.particles_across};
  for (mpm::Side& side : scene.sides) side = mpm::Side::wall(Vec2::Zero());
  scene.fluid = fluid_;
  scene.initial_velocity = [solution = solution_](const Vec2& x) {
    const auto v = solution->velocity(x.x(), x.y(), 0);
    return Vec2(v[0], v[1]);
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

std::shared_ptr<const ExactField> WalledVortexFlow::exact(const std::vector<double>&) const {
  return std::make_shared<WalledVortexField>(solution_, fluid_.density * parameters_.side * parameters_.side);
}

Probe WalledVortexFlow::probe() const {
  return {parameters_.side * Vec2(0.5, 0.25), Vec2(1, 0)};  // where u is largest
}

}  // namespace verification
