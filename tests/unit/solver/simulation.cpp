#include "solver/simulation.hpp"

#include <cmath>

#include "solver/step/time_step.hpp"
#include "tests/catch.hpp"

using namespace mpm;

namespace {

Scene periodic_box(int nx, int ny) {
  Scene scene;
  scene.size = {1e-4 * nx, 1e-4 * ny};
  scene.cells = {nx, ny};
  scene.fluid.rheology = Newtonian{1e-3};
  return scene;
}

Scheme stepping(Scheme::Stepping s) {
  Scheme scheme;
  scheme.stepping = s;
  return scheme;
}

Outcome run_to(Simulation& simulation, const Scene& scene, double dt, double end) {
  return run(
      simulation, plan_segments({dt}, scene, {end}), [](double) {}, [](double) {});
}

}  // namespace

TEST_CASE("rigid translation through many cells leaves velocity, density and stress untouched") {
  Scene scene = periodic_box(4, 3);
  const Vec2 velocity(0.02, -0.013);
  scene.initial_velocity = [=](const Vec2&) { return velocity; };
  const auto simulation = make_simulation(
      scene, stepping(GENERATE(Scheme::Stepping::Usf, Scheme::Stepping::Usl, Scheme::Stepping::Musl)));
  const Outcome outcome =
      run_to(*simulation, scene, 1e-5, 0.05);  // ten cells along x, particles on edges on the way
  REQUIRE_FALSE(outcome.breakdown);
  CHECK(outcome.steps == 5000);
  const Particles& p = simulation->particles();
  for (std::size_t i = 0; i < p.size(); ++i) {
    // Round-off of 5,000 steps, 1e-16 each, in a random walk and with margin.
    REQUIRE((p.velocity[i] - velocity).norm() < 1e-12 * velocity.norm());
    REQUIRE(std::abs(p.density[i] / 1000 - 1) < 1e-11);
    REQUIRE(p.stress[i].norm() < 1e-8);
  }
}

TEST_CASE("uniform body acceleration on a periodic box accelerates all of it alike") {
  Scene scene = periodic_box(2, 2);
  scene.body_acceleration = [](double) { return Vec2(3, -1); };
  const auto simulation = make_simulation(scene, {});
  REQUIRE_FALSE(run_to(*simulation, scene, 1e-5, 1e-3).breakdown);
  for (const Vec2& v : simulation->particles().velocity) REQUIRE((v - Vec2(3e-3, -1e-3)).norm() < 1e-15);
  const Totals totals = simulation->totals();
  CHECK((totals.momentum - totals.impulse).norm() < 1e-13 * totals.momentum.norm());
  CHECK(totals.mass == Approx(1000 * scene.size.x() * scene.size.y()).epsilon(1e-14));
}

TEST_CASE("an impulsively started plate hands particles the wall node's share, on any side") {
  for (const Edge edge : {Edge::Left, Edge::Right, Edge::Bottom, Edge::Top}) {
    Scene scene = periodic_box(4, 4);
    const bool across_x = edge == Edge::Left || edge == Edge::Right;
    const Vec2 plate = across_x ? Vec2(0, 0.1) : Vec2(0.1, 0);
    scene.side(across_x ? Edge::Left : Edge::Bottom) = Side::wall(Vec2::Zero());
    scene.side(across_x ? Edge::Right : Edge::Top) = Side::wall(Vec2::Zero());
    scene.side(edge) = Side::wall(plate);
    const auto simulation = make_simulation(scene, {});
    const Particles& p = simulation->particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double far = edge == Edge::Right ? scene.size.x() : edge == Edge::Top ? scene.size.y() : 0;
      const double distance = std::abs((across_x ? p.position[i].x() : p.position[i].y()) - far) / 1e-4;
      REQUIRE((p.velocity[i] - std::max(0.0, 1 - distance) * plate).norm() < 1e-15);
    }
  }
}

TEST_CASE("a wall that an initial field agrees with takes no share") {
  Scene scene = periodic_box(1, 8);
  scene.side(Edge::Bottom) = Side::wall(Vec2::Zero());
  scene.side(Edge::Top) = Side::wall(Vec2(0.8, 0));
  scene.initial_velocity = [](const Vec2& x) { return Vec2(x.y() * 1e3, 0); };
  const auto simulation = make_simulation(scene, {});
  const Particles& p = simulation->particles();
  for (std::size_t i = 0; i < p.size(); ++i)
    REQUIRE(p.velocity[i].x() == Approx(p.position[i].y() * 1e3).epsilon(1e-12));
}

TEST_CASE("the grid field carries the walls' velocity and leaves the state alone") {
  Scene scene = periodic_box(2, 4);
  scene.side(Edge::Bottom) = Side::wall(Vec2(-0.3, 0));
  scene.side(Edge::Top) = Side::wall(Vec2(0.2, 0));
  const auto simulation = make_simulation(scene, {});
  const VectorField before = simulation->particles().velocity;
  const VectorField corners = cell_corners(scene);
  REQUIRE(corners.size() == 10);
  const VectorField field = simulation->grid_field(corners, 0);
  CHECK(field.front() == Vec2(-0.3, 0));
  CHECK(field.back() == Vec2(0.2, 0));
  CHECK(simulation->particles().velocity == before);
}

TEST_CASE("a step far beyond the viscous limit is a recorded breakdown, not a crash") {
  Scene scene = periodic_box(1, 10);
  scene.side(Edge::Bottom) = Side::wall(Vec2::Zero());
  scene.side(Edge::Top) = Side::wall(Vec2(0.1, 0));
  scene.fluid.pressure = GENERATE(true, false);
  const auto simulation = make_simulation(scene, {});
  const Outcome outcome = run_to(*simulation, scene, 5 * 1e-8 / 1e-6, 1e3);
  REQUIRE(outcome.breakdown);
  CHECK(outcome.time > 0);
  CHECK(outcome.time < 1e3);
}

TEST_CASE("the same scene gives the same bits") {
  Scene scene = periodic_box(3, 6);
  scene.initial_velocity = [](const Vec2& x) {
    return Vec2(1e-2 * std::sin(2e4 * x.y()), 1e-2 * std::cos(2e4 * x.x()));
  };
  const auto run_once = [&] {
    const auto simulation = make_simulation(scene, {});
    REQUIRE_FALSE(run_to(*simulation, scene, 1e-5, 5e-3).breakdown);
    return simulation->particles().velocity;
  };
  CHECK(run_once() == run_once());
}

TEST_CASE("a uniform acceleration does the same whether it is given as uniform or as a field") {
  Scene uniform = periodic_box(3, 4), field = uniform;
  uniform.body_acceleration = [](double t) { return Vec2(2e-2 * t, -1e-3); };
  field.acceleration_field = [](const VectorField&, double t, VectorField& b) {
    std::fill(b.begin(), b.end(), Vec2(2e-2 * t, -1e-3));
  };
  Scheme scheme;
  scheme.basis = GENERATE(Scheme::Basis::Linear, Scheme::Basis::Cubic);
  const auto expected = make_simulation(uniform, scheme), observed = make_simulation(field, scheme);
  REQUIRE_FALSE(run_to(*expected, uniform, 1e-5, 1e-3).breakdown);
  REQUIRE_FALSE(run_to(*observed, field, 1e-5, 1e-3).breakdown);
  const Vec2 momentum = expected->totals().momentum;
  REQUIRE(momentum.norm() > 0);
  // Round-off of 100 steps.
  CHECK((observed->totals().momentum - momentum).norm() < 1e-13 * momentum.norm());
  CHECK((observed->totals().impulse - momentum).norm() < 1e-13 * momentum.norm());
}

TEST_CASE("particles start with the scene's density, and the mass that fills their share of a cell") {
  Scene scene = periodic_box(2, 4);
  scene.initial_density = [](const Vec2& x) { return 1000 + 1e4 * x.y(); };
  const auto simulation = make_simulation(scene, {});
  const Particles& p = simulation->particles();
  const double share = scene.cell_size(0) * scene.cell_size(1) / 4;
  for (std::size_t i = 0; i < p.size(); ++i) {
    // Particles carry mass and volume: their quotient is the density to a round-off or two.
    CHECK(p.density[i] == Approx(1000 + 1e4 * p.position[i].y()).epsilon(1e-15));
    CHECK(p.mass[i] == Approx(p.density[i] * share).epsilon(1e-14));
  }
}

TEST_CASE("a lid drives its cavity without pushing anything through the walls") {
  Scene scene = periodic_box(10, 10);
  for (Side& side : scene.sides) side = Side::wall(Vec2::Zero());
  scene.side(Edge::Top) = Side::wall(Vec2(1e-3, 0));
  const auto simulation = make_simulation(scene, {});
  const VectorField corners = cell_corners(scene);
  const VectorField field = simulation->grid_field(corners, 0);
  CHECK(field.back() == Vec2::Zero());                  // the corner belongs to both walls
  CHECK(field[field.size() - 2] == Vec2(1e-3, 0));      // its neighbour to the lid alone
  const Vec2 at_start = simulation->totals().momentum;  // the impulsive start's, before any force has acted
  const Outcome outcome = run_to(*simulation, scene, 2.5e-5, 0.1);
  REQUIRE_FALSE(outcome.breakdown);
  // The vortex turns with the lid: fluid moves back along the bottom half.
  CHECK(simulation->grid_field({Vec2(0.5e-3, 0.3e-3)}, 0.1).front().x() < 0);
  const Totals totals = simulation->totals();
  // Round-off of 4,000 steps, relative to the momentum of the lid's velocity.
  CHECK((totals.momentum - at_start - totals.impulse).norm() < 1e-12 * totals.mass * 1e-3);
}
