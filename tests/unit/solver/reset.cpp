#include <cmath>
#include <limits>
#include <numbers>

#include "solver/scene/seeding.hpp"
#include "solver/simulation.hpp"
#include "tests/catch.hpp"

using namespace mpm;
using std::numbers::pi;

namespace {

/// A vortex carried by a stream in a periodic box of 1 m, c = 10 m/s.
Scene vortex(int cells) {
  Scene scene;
  scene.cells = {cells, cells};
  scene.fluid.bulk_modulus = 1e5 / 7;
  scene.fluid.rheology = Newtonian{10};
  scene.initial_velocity = [](const Vec2& x) {
    return Vec2(0.3 + std::sin(2 * pi * x.x()) * std::cos(2 * pi * x.y()),
                -0.2 - std::cos(2 * pi * x.x()) * std::sin(2 * pi * x.y()));
  };
  return scene;
}

/// The same between plates, the upper one moving.
Scene walled(int cells) {
  Scene scene = vortex(cells);
  scene.side(Edge::Bottom) = Side::wall(Vec2::Zero());
  scene.side(Edge::Top) = Side::wall(Vec2(1, 0));
  scene.initial_velocity = [](const Vec2& x) {
    const double s = std::sin(pi * x.y());
    return Vec2(x.y() + 0.1 * std::sin(2 * pi * x.y()) * std::sin(2 * pi * x.x()),
                -0.2 * s * s * std::cos(2 * pi * x.x()));
  };
  return scene;
}

template <class Enum, class Parts>
std::vector<Enum> all(const Parts& parts) {
  std::vector<Enum> values;
  for (std::size_t i = 0; i < parts.size(); ++i) values.push_back(static_cast<Enum>(i));
  return values;
}

}  // namespace

TEST_CASE("particle reset: every scheme keeps mass and momentum, between walls too") {
  const bool has_walls = GENERATE(false, true);
  const Scene scene = has_walls ? walled(5) : vortex(5);
  for (const auto basis : all<Scheme::Basis>(basis_parts()))
    for (const auto transfer : all<Scheme::Transfer>(transfer_parts()))
      for (const auto stepping : all<Scheme::Stepping>(stepping_parts())) {
        Scheme scheme;
        scheme.basis = basis;
        scheme.transfer = transfer;
        scheme.stepping = stepping;
        scheme.reset_every = 2;
        INFO(name(basis) << " " << name(transfer) << " " << name(stepping) << (has_walls ? " walls" : ""));
        const auto simulation = make_simulation(scene, scheme);
        const Totals start = simulation->totals();
        const double dt = 1e-3;
        for (int k = 0; k < 6; ++k) {
          simulation->advance(k * dt, dt);
          REQUIRE_FALSE(simulation->breakdown());
        }
        const Totals end = simulation->totals();
        // Round-off of sums over 100 particles and of 6 steps; the implicit solver stops at 1e-12 of a step.
        CHECK(std::abs(end.mass / start.mass - 1) < 1e-14);
        CHECK((end.momentum - start.momentum - end.impulse).norm() < 2e-13 * start.mass);
        // The lattice, exactly; steps 2, 4 and 6 ended with a reset.
        CHECK(simulation->particles().position == seed_particles(scene).position);
      }
}

TEST_CASE("particle reset: a field that the grid holds survives it") {
  // One step so short that nothing happens but the reset: what the lattice samples is the projected field.
  Scheme scheme;
  scheme.basis = GENERATE(Scheme::Basis::Quadratic, Scheme::Basis::Cubic);
  scheme.transfer = GENERATE(Scheme::Transfer::Apic, Scheme::Transfer::FullMass);
  scheme.stepping = Scheme::Stepping::Leapfrog;
  const Scene scene = vortex(12);
  const auto plain = make_simulation(scene, scheme);
  scheme.reset_every = 1;
  const auto reset = make_simulation(scene, scheme);
  const double dt = 1e-9;
  plain->advance(0, dt);
  reset->advance(0, dt);
  const VectorField points = sample_points(scene, scheme);
  const VectorField a = plain->grid_field(points, dt), b = reset->grid_field(points, dt);
  double most = 0;
  for (std::size_t i = 0; i < points.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  // Full mass: P2G of the sampled field gives it back, to the solver's 1e-14 times the matrix's condition,
  // and 1e-9 s of motion. APIC: one more lumped map, O(h^2) of the quarter wave's 1 m/s.
  CHECK(most < (scheme.transfer == Scheme::Transfer::FullMass ? 1e-8 : 0.1));
  // Density: uniform before and after.
  for (const double density : reset->particles().density) CHECK(density == Approx(1000).epsilon(1e-8));
}

TEST_CASE("particle reset: by strain it happens when the fluid has been strained so far") {
  Scheme scheme;
  scheme.transfer = Scheme::Transfer::FullMass;
  scheme.stepping = Scheme::Stepping::Leapfrog;
  scheme.basis = Scheme::Basis::Cubic;
  scheme.reset_strain = 0.1;
  const Scene scene = vortex(16);
  const auto simulation = make_simulation(scene, scheme);
  const VectorField lattice = seed_particles(scene).position;
  // sqrt(2 D:D) is 4 pi at most, times cos^2(2 pi/64) at the nearest particles: strain reaches 0.1 after
  // 8.04 ms, in the ninth step.
  int first = 0;
  for (int k = 1; k <= 12 && first == 0; ++k) {
    simulation->advance((k - 1) * 1e-3, 1e-3);
    if (simulation->particles().position == lattice) first = k;
  }
  CHECK(first == 9);
  // Strain is counted anew from there: the next steps are ordinary ones, until as much has gathered again.
  int second = 0;
  for (int k = 10; k <= 24 && second == 0; ++k) {
    simulation->advance((k - 1) * 1e-3, 1e-3);
    if (simulation->particles().position == lattice) second = k;
  }
  // The vortex has lost exp(-2 nu (2 pi)^2 8.5e-3) = 0.7 % of its speed by then: a ninth step again.
  CHECK(second == 18);
}

TEST_CASE("particle reset: Taylor-Green-like vortex lives with it and dies without") {
  Scheme scheme;
  scheme.transfer = Scheme::Transfer::FullMass;
  scheme.stepping = Scheme::Stepping::Leapfrog;
  scheme.basis = Scheme::Basis::Cubic;
  scheme.reset_every = GENERATE(0, 10);
  Scene scene = vortex(12);
  scene.initial_velocity = [](const Vec2& x) {
    return Vec2(std::sin(2 * pi * x.x()) * std::cos(2 * pi * x.y()),
                -std::cos(2 * pi * x.x()) * std::sin(2 * pi * x.y()));
  };
  const auto simulation = make_simulation(scene, scheme);
  const double dt = 2.5e-3;
  int steps = 0;
  while (steps < 200 && !simulation->breakdown()) {
    simulation->advance(steps * dt, dt);
    ++steps;
  }
  CHECK((steps == 200) == (scheme.reset_every > 0));
}

TEST_CASE("particle reset: its name, and what it refuses") {
  Scheme scheme;
  CHECK(reset_name(scheme) == "never");
  scheme.reset_every = 25;
  CHECK(reset_name(scheme) == "every 25 steps");
  scheme.reset_strain = 0.5;
  CHECK(reset_name(scheme) == "every 25 steps or strain of 0.5");
  scheme.reset_every = 0;
  CHECK(reset_name(scheme) == "every strain of 0.5");
  scheme.reset_strain = -1;
  CHECK_THROWS_WITH(scheme.validate(), contains("reset_strain"));
  scheme.reset_strain = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(scheme.validate(), contains("reset_strain"));
  scheme.reset_strain = 0;
  scheme.reset_every = -1;
  CHECK_THROWS_WITH(scheme.validate(), contains("reset_every"));
}
