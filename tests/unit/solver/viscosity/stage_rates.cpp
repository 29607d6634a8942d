#include "solver/step/stage_rates.hpp"

#include "tests/catch.hpp"

using namespace mpm;

TEST_CASE("an acceleration that is linear in time is guessed exactly, from two stages on") {
  const auto acceleration = [](double t) { return Vec2(3 - 2 * t, 0.5 * t); };
  StageRates rates;
  const VectorField start(2, Vec2(0.1, 0.2));
  VectorField velocity(2, Vec2(7, 7));
  double t = 0, dt = 0.3;
  for (int stage = 0; stage < 2; ++stage, t += dt) {
    rates.guess(start, dt, 1, velocity);
    CHECK(velocity[0] == Vec2(7, 7));
    rates.keep(start, dt, VectorField(2, start[0] + dt * acceleration(t)));
  }
  rates.guess(start, 0.2, 2.5, velocity);  // 2.5 times 0.3 s after 0.3 s
  for (const Vec2& v : velocity) CHECK((v - start[0] - 0.2 * acceleration(0.3 + 2.5 * 0.3)).norm() < 1e-15);
}
