#include <cmath>
#include <limits>

#include "solver/simulation.hpp"
#include "tests/catch.hpp"
#include "verification/flows/surface/column_at_rest.hpp"
#include "verification/flows/surface/gravity_current_flow.hpp"

using namespace verification;

namespace {

mpm::Fluid water() {
  mpm::Fluid fluid;
  fluid.bulk_modulus = 1000 * 100 / 7.0;  // c = 10 m/s
  fluid.rheology = mpm::Newtonian{1};
  return fluid;
}

}  // namespace

TEST_CASE("column at rest: fluid in the grid's own equilibrium does not move") {
  const double surface = GENERATE(1.0, 0.97);  // on a cell's edge, and with a cell half full
  mpm::Scene scene;
  scene.size = {4 / 16.0, 20 / 16.0};
  scene.cells = {4, 20};
  for (mpm::Side& side : scene.sides)
    side = mpm::Side::wall(Vec2::Zero(), std::numeric_limits<double>::infinity());
  scene.fluid = water();
  scene.body_acceleration = [](double) { return Vec2(0, -1); };
  scene.free_surface = mpm::FreeSurface{[surface](const Vec2& x) { return x.y() < surface; }};
  scene.initial_density = density_at_rest({surface, 1, 1 / 16.0, 2}, scene.fluid);
  mpm::Scheme scheme;
  scheme.dilatation = mpm::Scheme::Dilatation::Cell;
  const auto simulation = mpm::make_simulation(scene, scheme);
  for (int k = 0; k < 2000; ++k) simulation->advance(k * 2e-3, 2e-3);
  double largest = 0;
  for (const Vec2& v : simulation->particles().velocity) largest = std::max(largest, v.norm());
  CHECK(largest < 1e-11);
  // The mass is that of the hydrostatic density of the fluid, to O(h^2).
  double mass = 0;
  for (const double m : simulation->particles().mass) mass += m;
  const double filled = surface == 1.0 ? 1.0 : 15.5 / 16;
  CHECK(mass / (0.25 * filled * 1000) == Approx(1 + filled / 200).epsilon(1e-4));  // 1 + g H/(2 c^2)
}

TEST_CASE("gravity current: other fluids have no similarity solution") {
  GravityCurrentFlowParameters p;
  p.front = 8;
  p.aspect_ratio = 8;
  p.age = 1;
  p.fluid.kinematic_viscosity = 4;
  p.fluid.solver = water();
  p.fluid.curve = reference::NewtonianCurve{4};
  const GravityCurrentFlow flow(p);
  CHECK(flow.spreading()->front(0) == 8);
  CHECK(flow.spreading()->front(31) == Approx(16));  // 32^(1/5)
  p.fluid.curve = reference::CrossCurve{4, 1, 1, 1};
  CHECK_THROWS_AS(GravityCurrentFlow(p), std::invalid_argument);
}
