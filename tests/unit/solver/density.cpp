#include <Eigen/LU>
#include <cmath>

#include "solver/grid/axis.hpp"
#include "solver/grid/grid.hpp"
#include "solver/material/stress_update.hpp"
#include "solver/scene/seeding.hpp"
#include "solver/simulation.hpp"
#include "tests/catch.hpp"

using namespace mpm;

namespace {

Scene walled_box() {
  Scene scene;
  scene.size = {1, 1};
  scene.cells = {5, 4};
  for (const Edge edge : {Edge::Left, Edge::Right, Edge::Bottom, Edge::Top})
    scene.side(edge) = Side::wall(Vec2::Zero());
  scene.fluid.rheology = Newtonian{1e-3};
  return scene;
}

}  // namespace

TEMPLATE_TEST_CASE("the density update follows a linear velocity field by the volume ratio of its motion", "",
                   BSpline<1>, BSpline<2>, BSpline<3>) {
  const Scene scene = walled_box();
  const Grid grid(scene, TestType::degree);
  Mat2 l;
  l << 0.7, -1.9, 2.3, -0.4;
  VectorField velocity(grid.size());  // splines reproduce x from their control points
  for (std::size_t i = 0; i < grid.size(); ++i) velocity[i] = l * grid.control_point(i);
  const auto update = make_stress_update<TestType>(scene, Scheme{});
  const double dt = 0.05;

  Particles compressed = seed_particles(scene), updated = compressed;
  update->compress(compressed, grid, velocity, dt);
  (*update)(updated, grid, velocity, dt);
  const double volume_ratio = (Mat2::Identity() + dt * l).determinant();
  for (std::size_t p = 0; p < compressed.size(); ++p) {
    CHECK(compressed.density[p] == Approx(1000 / volume_ratio).epsilon(1e-13));
    CHECK(updated.density[p] == Approx(1000 / (1 + dt * l.trace())).epsilon(1e-13));
  }
  // The two differ by dt^2 det L in the ratio: what makes the second one first order.
  CHECK(volume_ratio - (1 + dt * l.trace()) == Approx(dt * dt * l.determinant()).epsilon(1e-12));
}

TEST_CASE("a run may start at any time beside a moving wall: no jump, whatever the clock says") {
  Scene scene;
  scene.size = {0.1, 1};
  scene.cells = {1, 10};
  scene.fluid.pressure = false;
  scene.fluid.rheology = Newtonian{1e-9};
  scene.start = 2;
  scene.initial_velocity = [](const Vec2&) { return Vec2(std::cos(2.0), 0); };
  Side wall;
  wall.periodic = false;
  wall.velocity = [](double t) { return Vec2(std::cos(t), 0); };
  wall.acceleration = [](double t) { return Vec2(-std::sin(t), 0); };
  scene.side(Edge::Bottom) = scene.side(Edge::Top) = wall;
  const auto transfer = GENERATE(Scheme::Transfer::Flip, Scheme::Transfer::Apic, Scheme::Transfer::FullMass);
  const auto simulation = make_simulation(scene, {Scheme::Basis::Linear, transfer});
  for (const Vec2& v : simulation->particles().velocity) CHECK(v.x() == Approx(std::cos(2.0)).epsilon(1e-13));
}
