#include <cmath>
#include <numbers>

#include "solver/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/unit/solver/kernel_comparison.hpp"

using namespace mpm;
using namespace kernel_comparison;

TEST_CASE("vector kernels: the consistent mass in leapfrog steps, periodic and between walls") {
  const int walls = GENERATE(0, 1, 2);
  // As short as a row of the cubic mass matrix, and shorter.
  const auto [nx, ny] = GENERATE(std::pair{7, 18}, std::pair{9, 7}, std::pair{3, 8});
  for (const Scheme::Basis basis : bases)
    for (const bool pressure : {true, false}) {
      // Three periodic cells are none of the kernel's but for the linear basis.
      if (nx == 3 && walls < 2 && basis != Scheme::Basis::Linear) continue;
      Scene scene = whirl(nx, ny);
      scene.particles_per_cell = {3, 3};
      scene.fluid.pressure = pressure;
      if (walls >= 1) {
        scene.side(Edge::Bottom) = Side::wall(Vec2(0.02, 0));
        scene.side(Edge::Top) = Side::wall(Vec2(-0.01, 0));
      }
      if (walls == 2) scene.side(Edge::Left) = scene.side(Edge::Right) = Side::wall(Vec2::Zero());
      if (walls >= 1)
        scene.initial_velocity = [size = scene.size](const Vec2& x) {
          const double s = std::sin(std::numbers::pi * x.x() / size.x());
          return Vec2(0.05 * s * std::sin(1e4 * x.y()), 0);
        };
      Scheme scheme{basis, Scheme::Transfer::FullMass, Scheme::Stepping::Leapfrog};
      INFO("walls " << walls << ", " << nx << " x " << ny << (pressure ? "" : ", no pressure"));
      require_same_as_plain(scene, scheme, 4e-6);
      scheme.reset_every = 7;
      require_same_as_plain(scene, scheme, 4e-6);
      scheme.reset_every = 0;
      scheme.reset_strain = 0.1;
      require_same_as_plain(scene, scheme, 4e-6);
    }
}

TEST_CASE("vector kernels: the consistent mass under forces that vary in space and time") {
  for (const Scheme::Basis basis : bases)
    for (const bool walls : {false, true}) {
      Scene scene = whirl(7, 18);  // the longer side along the lanes
      const Vec2 k = 2 * std::numbers::pi * scene.size.cwiseInverse();
      scene.acceleration_field = [k](const VectorField& points, double t, VectorField& acceleration) {
        for (std::size_t p = 0; p < points.size(); ++p)
          acceleration[p] = {40 * std::sin(k.y() * points[p].y() + 3e3 * t),
                             90 * std::cos(k.x() * points[p].x())};
      };
      if (walls) {
        scene.side(Edge::Bottom) = Side::wall(Vec2(0.02, 0));
        scene.side(Edge::Top) = Side::wall(Vec2(-0.01, 0));
        scene.initial_velocity = [](const Vec2& x) { return Vec2(0.05 * std::sin(1e4 * x.y()), 0); };
      }
      Scheme scheme{basis, Scheme::Transfer::FullMass, Scheme::Stepping::Leapfrog};
      scheme.reset_every = 7;
      require_same_as_plain(scene, scheme, 4e-6);
    }
}

TEST_CASE(
    "the consistent mass in the kernel: who asks between steps changes no bit, and gets what is asked for") {
  Scene scene = whirl(9, 8);
  scene.side(Edge::Bottom) = Side::wall(Vec2(0.02, 0));
  scene.side(Edge::Top) = Side::wall(Vec2(-0.01, 0));
  scene.initial_velocity = [](const Vec2& x) { return Vec2(0.05 * std::sin(1e4 * x.y()), 0); };
  Side& top = scene.side(Edge::Top);
  top.velocity = [](double t) { return Vec2(100 * t, 0); };
  top.acceleration = [](double) { return Vec2(100, 0); };
  Scheme scheme{Scheme::Basis::Cubic, Scheme::Transfer::FullMass, Scheme::Stepping::Leapfrog};
  scheme.reset_every = 3;
  const auto left_alone = make_simulation(scene, scheme), asked = make_simulation(scene, scheme);
  const VectorField points{{0.3 * cell, 2.2 * cell}, {1.7 * cell, 8 * cell}};  // the second on the upper wall
  const double dt = 4e-6;
  for (int k = 0; k < 8; ++k) {
    for (const auto* simulation : {&left_alone, &asked}) (*simulation)->advance(k * dt, dt);
    const double t = (k + 1) * dt;
    CHECK(asked->grid_field(points, t)[1].x() == Approx(100 * t).epsilon(1e-13));
    CHECK(asked->grid_field(points, 2 * t)[1].x() == Approx(200 * t).epsilon(1e-13));
    const Totals of_kernel = asked->totals(), summed = totals_of(asked->particles(), of_kernel.impulse);
    CHECK(of_kernel.mass == Approx(summed.mass).epsilon(1e-14));
    CHECK((of_kernel.momentum - summed.momentum).norm() < 1e-14 * summed.mass * 0.05);
    CHECK(of_kernel.kinetic_energy == Approx(summed.kinetic_energy).epsilon(1e-14));
  }
  CHECK(left_alone->particles().position == asked->particles().position);
  CHECK(left_alone->particles().velocity == asked->particles().velocity);
  CHECK(left_alone->particles().density == asked->particles().density);
}

TEST_CASE("the number of threads changes no bit of the consistent mass") {
  for (const auto basis : {Scheme::Basis::Linear, Scheme::Basis::Quadratic, Scheme::Basis::Cubic})
    for (const bool walls : {false, true}) {
      Scene scene;
      scene.cells = {19, 41};  // bands that differ in height
      scene.size = {19e-4, 41e-4};
      scene.fluid.rheology = Newtonian{1e-3};
      scene.initial_velocity = [k = Vec2(2 * std::numbers::pi * scene.size.cwiseInverse())](const Vec2& x) {
        return Vec2(0.1 + 0.05 * std::sin(k.y() * x.y()), -0.07 + 0.04 * std::cos(k.x() * x.x()));
      };
      scene.particles_per_cell = {3, 3};
      scene.seeding.displacement = 0.3;
      if (walls) {
        scene.side(Edge::Bottom) = Side::wall(Vec2(0.02, 0));
        scene.side(Edge::Top) = Side::wall(Vec2(-0.01, 0));
        scene.initial_velocity = [](const Vec2& x) { return Vec2(0.1 * std::sin(1e3 * x.y()), 0); };
      }
      Scheme scheme{basis, Scheme::Transfer::FullMass, Scheme::Stepping::Leapfrog};
      scheme.reset_every = 6;
      const auto run = [&](int threads) {
        auto simulation = make_simulation(scene, scheme, threads);
        for (int k = 0; k < 20; ++k) simulation->advance(k * 4e-6, 4e-6);
        REQUIRE_FALSE(simulation->breakdown());
        return simulation;
      };
      const auto one = run(1);
      for (const int threads : {2, 3}) {
        const auto several = run(threads);
        CHECK(one->particles().position == several->particles().position);
        CHECK(one->particles().velocity == several->particles().velocity);
        CHECK(one->particles().density == several->particles().density);
        CHECK(one->totals().impulse == several->totals().impulse);
      }
    }
}
