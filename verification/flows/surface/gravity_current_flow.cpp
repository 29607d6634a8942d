#include "verification/flows/surface/gravity_current_flow.hpp"

#include <limits>
#include <stdexcept>

#include "reference/compressible/tait_column.hpp"

namespace verification {
namespace {

double index_of(const FluidConfig& fluid) {
  if (const auto* law = std::get_if<reference::PowerLawCurve>(&fluid.curve.model())) return law->n;
  if (fluid.curve.newtonian()) return 1;
  throw std::invalid_argument(
      "a gravity current has a similarity solution for Newtonian and power-law fluids");
}

reference::GravityCurrentParameters current_of(const GravityCurrentFlowParameters& p, double index) {
  const double height = p.front / p.aspect_ratio;
  return {p.front * height * reference::GravityCurrent::fullness(index), 0, p.fluid.kinematic_viscosity,
          index};
}

}  // namespace

GravityCurrentFlow::GravityCurrentFlow(const GravityCurrentFlowParameters& parameters)
    : parameters_(parameters),
      index_(index_of(parameters.fluid)),
      gravity_(reference::GravityCurrent::gravity_of(parameters.front, parameters.age,
                                                     current_of(parameters, index_))) {}

mpm::Scene GravityCurrentFlow::scene(const Discretisation& d) const {
  const GravityCurrentFlowParameters& p = parameters_;
  reference::GravityCurrentParameters current_parameters = current_of(p, index_);
  current_parameters.gravity = gravity_;
  const reference::GravityCurrent current(current_parameters);
  const mpm::Fluid& fluid = p.fluid.solver;
  const reference::TaitColumn column({height(), gravity_, fluid.sound_speed(), fluid.density});
  constexpr double slips_freely = std::numeric_limits<double>::infinity();
  mpm::Scene scene;
  scene.size = {p.room * p.front, length()};
  scene.cells = {d.cells_along, d.cells};
  scene.particles_per_cell = {d.particles_along, d.particles_across};
  for (mpm::Side& side : scene.sides) side = mpm::Side::wall(Vec2::Zero(), slips_freely);
  scene.side(mpm::Edge::Bottom) = mpm::Side::wall(Vec2::Zero());
  scene.fluid = fluid;
  scene.body_acceleration = [g = gravity_](double) { return Vec2(0, -g); };
  const auto surface = [current, age = p.age](const Vec2& x) { return current.height(x.x(), age); };
  scene.free_surface = mpm::FreeSurface{[surface](const Vec2& x) { return x.y() < surface(x); }};
  scene.initial_density = [column, surface, top = height()](const Vec2& x) {
    return column.density(top - surface(x) + x.y());
  };
  return scene;
}

std::optional<Spreading> GravityCurrentFlow::spreading() const {
  return Spreading{parameters_.age, reference::GravityCurrent::exponent(index_), parameters_.front};
}

double GravityCurrentFlow::velocity_scale() const {
  return reference::GravityCurrent::exponent(index_) * parameters_.front / parameters_.age;
}

Probe GravityCurrentFlow::probe() const {
  return {{0.5 * parameters_.front, 0.25 * height()}, {1, 0}};
}

}  // namespace verification
