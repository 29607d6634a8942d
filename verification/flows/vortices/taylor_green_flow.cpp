#include "verification/flows/vortices/taylor_green_flow.hpp"

#include "solver/material/pressure.hpp"

namespace verification {
namespace {

class TaylorGreenField final : public ExactField {
 public:
  explicit TaylorGreenField(std::shared_ptr<const reference::TaylorGreen> solution)
      : solution_(std::move(solution)) {}
  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location) const override {
    const auto v = solution_->velocity(x.x(), x.y(), t);
    return {v[0], v[1]};
  }
  [[nodiscard]] std::optional<double> pressure(const Vec2& x, double t) const override {
    return solution_->pressure(x.x(), x.y(), t);
  }
  [[nodiscard]] std::optional<double> kinetic_energy(double t) const override {
    return solution_->kinetic_energy(t);
  }
  [[nodiscard]] std::string description() const override {
    return "Taylor-Green vortex, exact incompressible Navier-Stokes";
  }

 private:
  std::shared_ptr<const reference::TaylorGreen> solution_;
};

}  // namespace

TaylorGreenFlow::TaylorGreenFlow(const TaylorGreenFlowParameters& parameters)
    : parameters_(parameters),
      solution_(std::make_shared<reference::TaylorGreen>(
          reference::TaylorGreenParameters{parameters.amplitude, parameters.period,
                                           parameters.kinematic_viscosity, parameters.fluid.density})) {}

mpm::Scene TaylorGreenFlow::scene(const Discretisation& d) const {
  mpm::Scene scene;
  scene.size = Vec2::Constant(parameters_.period);
  scene.cells = {d.cells, d.cells};
  scene.particles_per_cell = {d.particles_along, d.particles_across};
  scene.fluid = parameters_.fluid;
  scene.initial_velocity = [field = TaylorGreenField(solution_)](const Vec2& x) {
    return field.velocity(x, 0, Location::Particles);
  };
  if (parameters_.fluid.pressure)
    scene.initial_density = [solution = solution_, tait = mpm::TaitPressure{parameters_.fluid.bulk_modulus,
                                                                            1 / parameters_.fluid.density}](
                                const Vec2& x) { return tait.density(solution->pressure(x.x(), x.y(), 0)); };
  return scene;
}

std::shared_ptr<const ExactField> TaylorGreenFlow::exact(const std::vector<double>&) const {
  return std::make_shared<TaylorGreenField>(solution_);
}

Probe TaylorGreenFlow::probe() const {
  return {parameters_.period * Vec2(0.25, 0), Vec2(1, 0)};  // where u is largest
}

}  // namespace verification
