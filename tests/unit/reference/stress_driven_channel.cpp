#include "reference/channel/traction/stress_driven_channel.hpp"

#include <cmath>
#include <stdexcept>

#include "reference/transient/transient_channel.hpp"
#include "tests/catch.hpp"

using namespace reference;

TEST_CASE("stress-driven start-up: modes and images are one solution", "[reference]") {
  const StressDrivenChannel channel(1e-3, 1e-6, 2e-7);
  for (const double t : {0.02, 0.1, 0.4, 1.0})
    for (const double y : {0.0, 1e-4, 5e-4, 9e-4, 1e-3})
      CHECK(std::abs(channel.by_modes(y, t) - channel.by_images(y, t)) < 2e-14 * channel.steady_maximum());
}

TEST_CASE("stress-driven start-up: the plate holds, the side pulls, the end is linear", "[reference]") {
  const double height = 1e-3, nu = 1e-6, stress = -3e-7;
  const StressDrivenChannel channel(height, nu, stress);
  for (const double t : {1e-3, 0.05, 0.2, 3.0}) {
    CHECK(channel.velocity(0, t) == 0);
    CHECK(channel.gradient(height, t) == Approx(stress / nu).epsilon(1e-12));
    const double e = 1e-7, y = 7e-4;
    CHECK(channel.gradient(y, t) ==
          Approx((channel.velocity(y + e, t) - channel.velocity(y - e, t)) / (2 * e))
              .epsilon(1e-5)
              .margin(1e-8 * std::abs(stress) / nu));
    // nu u_yy = u_t
    const double dt = 1e-4 * t, dy = 2e-6;
    const double bend =
        (channel.velocity(y + dy, t) - 2 * channel.velocity(y, t) + channel.velocity(y - dy, t)) / (dy * dy);
    const double rise = (channel.velocity(y, t + dt) - channel.velocity(y, t - dt)) / (2 * dt);
    CHECK(std::abs(nu * bend - rise) < 1e-3 * std::abs(stress) / height);
  }
  CHECK(channel.velocity(0.4e-3, 100) == Approx(stress / nu * 0.4e-3));
  CHECK(channel.steady_maximum() == Approx(3e-4));
  CHECK_THROWS_AS(StressDrivenChannel(1e-3, 1e-6, 0), std::invalid_argument);
}

TEST_CASE(
    "stress-driven channel: the computed start-up meets the series where the fluid is all but Newtonian") {
  constexpr double height = 1e-3, nu = 1e-6, pull = 1e-7;
  const std::vector<double> times{0.02, 0.1, 0.5};
  const TransientChannel computed({height, 0, 0, PowerLawCurve{nu, 1 + 1e-9}, times, 0, pull});
  const StressDrivenChannel series(height, nu, pull);
  CHECK(computed.stated_error() < 1e-6);
  for (const double t : times)
    for (const double y : {0.1e-3, 0.5e-3, 0.9e-3, 0.99e-3, 1e-3}) {
      INFO(y << " m, " << t << " s");
      CHECK(std::abs(computed.velocity(y, t) - series.velocity(y, t)) < 1e-6 * pull / nu * height);
      CHECK(std::abs(computed.gradient(y, t) - series.gradient(y, t)) < 1e-4 * pull / nu);
    }
}

TEST_CASE("stress-driven channel: every fluid comes to the rate that has the stress") {
  constexpr double height = 1e-3, pull = 5e-7;
  const FlowCurve curve =
      GENERATE(FlowCurve(PowerLawCurve{1e-6, 0.6}), FlowCurve(PowerLawCurve{1e-6, 1.4}),
               FlowCurve(CrossCurve{1e-6, 0.25e-6, 1, 1}), FlowCurve(CrossCurve{1e-6, 4e-6, 1, 1}));
  const TransientChannel computed({height, 0, 0, curve, {0.1, 20}, 0, pull});
  INFO(computed.description());
  CHECK(computed.stated_error() < 1e-5);
  for (const double y : {0.2e-3, 0.6e-3, 1e-3})
    CHECK(computed.velocity(y, 20) == Approx(curve.rate(pull) * y).epsilon(1e-4));
  CHECK(computed.velocity(0.1e-3, 0.1) < 0.5 * computed.velocity(0.1e-3, 20));
}
