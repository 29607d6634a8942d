#include <cmath>
#include <numbers>

#include "solver/simulation.hpp"
#include "tests/catch.hpp"

using namespace mpm;

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
