#include "solver/step/time_step.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace mpm;

namespace {

Scene channel() {
  Scene scene;
  scene.size = {1e-4, 1e-3};
  scene.cells = {1, 10};
  scene.fluid.rheology = Newtonian{1e-3};
  return scene;
}

}  // namespace

TEST_CASE("segments end exactly on the output times") {
  const std::vector<double> outputs = {0.05, 0.1, 0.25, 1.0};
  const double dt = GENERATE(5e-6, 7.3e-4, 0.03, 2.0);
  const auto segments = plan_segments({dt}, channel(), outputs);
  REQUIRE(segments.size() == 4);
  double t = 0;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    CHECK(segments[s].begin == t);
    for (long k = 0; k < segments[s].steps; ++k) {
      REQUIRE(segments[s].length(k) > 0);
      REQUIRE(segments[s].length(k) < dt * (1 + 1e-5));
    }
    CHECK(segments[s].time(segments[s].steps) == outputs[s]);
    t = outputs[s];
  }
}

TEST_CASE("a step that divides the interval is kept, another is clipped at the end") {
  CHECK(plan_segments({5e-6}, channel(), {0.05}).front().steps == 10000);
  CHECK(plan_segments({0.1}, channel(), {0.3}).front().steps == 3);
  const Segment clipped = plan_segments({0.04}, channel(), {0.1}).front();
  CHECK(clipped.steps == 3);
  CHECK(clipped.dt == 0.04);
  CHECK(clipped.length(2) == Approx(0.02));
}

TEST_CASE("a step from limits obeys the sharper one, in equal steps") {
  Scene scene = channel();
  const double h = 1e-4, c = scene.fluid.sound_speed();
  CHECK(nominal_time_step({0, 0.5, 0.2}, scene) == Approx(0.5 * h / c));
  scene.fluid.pressure = false;
  CHECK(nominal_time_step({0, 0.5, 0.2}, scene) == Approx(0.2 * h * h / 1e-6));
  const Segment segment = plan_segments({0, 0.5, 0.2}, scene, {0.03}).front();
  CHECK(segment.steps == 15);
  CHECK(segment.dt == Approx(0.002));
}

TEST_CASE("steps that cannot be meant are refused") {
  CHECK_THROWS_AS(plan_segments({-1e-3}, channel(), {1}), SceneError);
  CHECK_THROWS_AS(plan_segments({NAN}, channel(), {1}), SceneError);
  CHECK_THROWS_AS(plan_segments({1e-3}, channel(), {1, 0.5}), SceneError);
  CHECK_THROWS_AS(plan_segments({1e-15}, channel(), {1e6}), SceneError);
  Scene inviscid = channel();
  inviscid.fluid.pressure = false;
  inviscid.fluid.rheology = Newtonian{0};
  CHECK_THROWS_AS(plan_segments({}, inviscid, {1}), SceneError);
}
