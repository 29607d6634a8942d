#include "reference/channel/steady_channel.hpp"

#include <cmath>
#include <vector>

#include "tests/catch.hpp"

using namespace reference;

namespace {

constexpr double kHeight = 1e-3, kForce = 8e-3, kPlate = 1e-4;

// Integral of the rate from 0 to y by the midpoint rule on a mesh squared towards the zero-shear point, in s
// panels.
double integrated(const FlowCurve& curve, const SteadyChannel& flow, double y, double zero, int panels) {
  double sum = 0.0;
  const auto part = [&](double from, double to) {
    for (int i = 0; i < panels; ++i) {
      const double a = double(i) / panels, b = double(i + 1) / panels, m = 0.5 * (a + b);
      sum += (to - from) * (b * b - a * a) * curve.rate(flow.stress(from + (to - from) * m * m));
    }
  };
  if (zero > 0.0 && zero < y) {
    part(zero, 0.0);
    sum = -sum;
    part(zero, y);
  } else {
    part(0.0, y);
  }
  return sum;
}

}  // namespace

TEST_CASE("steady channel: the closed forms of the power law and of the Newtonian fluid") {
  for (double n : {0.3, 0.6, 1.0, 1.4, 2.0}) {
    const SteadyChannel flow(kHeight, kForce, 0.0, PowerLawCurve{1e-6, n});
    const double b = 0.5 * kHeight, e = 1.0 + 1.0 / n;
    const auto exact = [&](double y) {
      return n / (n + 1.0) * std::pow(kForce / 1e-6, 1.0 / n) *
             (std::pow(b, e) - std::pow(std::abs(y - b), e));
    };
    for (double y : {1e-5, 0.2e-3, 0.5e-3, 0.7e-3, 0.99e-3}) {
      CHECK(std::abs(flow.velocity(y) - exact(y)) < 1e-14 * exact(b));  // two powers and a difference
    }
    CHECK(flow.maximum() == Approx(exact(b)).epsilon(1e-14));
    CHECK(flow.mid_height_velocity() == flow.maximum());
    CHECK(flow.velocity(0.25e-3) == flow.velocity(0.75e-3));
  }
  const SteadyChannel newtonian(kHeight, kForce, -kPlate, NewtonianCurve{1e-6});
  for (double y : {1e-5, 0.2e-3, 0.5e-3, 0.99e-3}) {
    CHECK(std::abs(newtonian.velocity(y) - (kForce / 2e-6 * y * (kHeight - y) - kPlate * y / kHeight)) <
          1e-14 * 1e-3);
  }
}

TEST_CASE("steady channel: velocity integrates the rate, for every fluid and drive") {
  const std::vector<FlowCurve> fluids{CrossCurve{1e-6, 0.25e-6, 1.0, 1.0},
                                      CrossCurve{1e-6, 4e-6, 1.0, 1.0},
                                      CrossCurve{1e-6, 0.1e-6, 1.0, 0.6},
                                      PowerLawCurve{1e-6, 0.6},
                                      PowerLawCurve{1e-6, 1.4},
                                      CarreauYasudaCurve{1e-6, 1e-8, 3.0, 2.0, 0.4}};
  for (const FlowCurve& curve : fluids) {
    INFO(curve.describe());
    for (const auto& drive :
         {std::pair{kForce, 0.0}, std::pair{kForce, kPlate}, std::pair{-kForce, 20 * kPlate},
          std::pair{1e-9, kPlate}, std::pair{kForce, -1e-12}}) {
      const SteadyChannel flow(kHeight, drive.first, drive.second, curve);
      const double zero = flow.stress(0.0) / drive.first;
      for (double y : {0.1e-3, 0.6e-3, kHeight}) {
        // Midpoint rule, 4000 panels: (1/4000)^2/24 times a second derivative of some tens: 1e-7.
        CHECK(std::abs(flow.velocity(y) - integrated(curve, flow, y, zero, 4000)) < 1e-6 * flow.maximum());
      }
      CHECK(flow.velocity(0.0) == 0.0);
      CHECK(flow.velocity(kHeight) == drive.second);
      // No jump to the exact plate value: what the root leaves is round-off of the largest velocity and the
      // slope's share.
      const double near = kHeight * (1.0 - 1e-15);
      CHECK(std::abs(flow.velocity(near) - drive.second) < 1e-13 * flow.maximum());
    }
  }
}

TEST_CASE("steady channel: Couette is a straight line for every fluid, weak forcing a small change to it") {
  for (const FlowCurve& curve :
       {FlowCurve(CrossCurve{1e-6, 4e-6, 1.0, 1.0}), FlowCurve(PowerLawCurve{1e-6, 0.6})}) {
    const SteadyChannel couette(kHeight, 0.0, kPlate, curve), forced(kHeight, 1e-12, kPlate, curve);
    for (double y : {0.1e-3, 0.5e-3, 0.9e-3}) {
      CHECK(couette.velocity(y) == Approx(kPlate * y / kHeight).epsilon(1e-14));
      CHECK(couette.gradient(y) == Approx(kPlate / kHeight).epsilon(1e-14));
      // F H^2/(8 nu') with a tangent viscosity of some 1e-6 is 1e-13 m/s, 1e-9 of V0.
      CHECK(forced.velocity(y) == Approx(couette.velocity(y)).epsilon(1e-8));
    }
    CHECK(couette.maximum() == kPlate);
  }
}

TEST_CASE("steady channel: signs, and the maximum inside or at the plate") {
  const FlowCurve curve = CrossCurve{1e-6, 0.25e-6, 1.0, 1.0};
  const SteadyChannel plus(kHeight, kForce, -kPlate, curve), minus(kHeight, -kForce, kPlate, curve);
  for (double y : {0.1e-3, 0.5e-3, 0.9e-3}) {
    CHECK(plus.velocity(y) == Approx(-minus.velocity(y)).epsilon(1e-13));
    CHECK(plus.gradient(y) == Approx(-minus.gradient(y)).epsilon(1e-13));
  }
  for (double plate : {kPlate, -kPlate, 0.02, -0.02}) {
    const SteadyChannel flow(kHeight, kForce, plate, curve);
    double largest = 0.0;
    for (int i = 0; i <= 2000; ++i) largest = std::max(largest, std::abs(flow.velocity(kHeight * i / 2000)));
    // Sampling misses a smooth top by (1/4000)^2 of its curvature.
    CHECK(flow.maximum() == Approx(largest).epsilon(1e-5));
    CHECK(flow.maximum() >= largest * (1 - 1e-14));
  }
}

TEST_CASE("steady channel: nodes of the linear scheme") {
  // Exact nodes for a Newtonian fluid: the midpoint rule integrates a straight line exactly.
  const SteadyChannel newtonian(kHeight, kForce, 0.0, NewtonianCurve{1e-6});
  const std::vector<double> line = newtonian.linear_scheme_nodes(20);
  for (int j = 0; j <= 20; ++j)
    CHECK(std::abs(line[j] - newtonian.velocity(kHeight * j / 20.0)) < 1e-14 * 1e-3);

  const FlowCurve curve = PowerLawCurve{1e-6, 0.6};
  const SteadyChannel flow(kHeight, kForce, 0.0, curve);
  for (int cells : {7, 20}) {  // odd: a cell around the middle, where the rate is zero
    const std::vector<double> u = flow.linear_scheme_nodes(cells);
    REQUIRE(u.size() == std::size_t(cells) + 1);
    const double h = kHeight / cells;
    for (int j = 0; j < cells; ++j) {
      const double rate = curve.rate(kForce * (0.5 * kHeight - (j + 0.5) * h));
      CHECK(std::abs(u[j + 1] - u[j] - h * rate) < 1e-14 * flow.maximum());
    }
    CHECK(u.front() == 0.0);
    CHECK(u.back() == 0.0);
  }
  const auto error = [&](int cells) {
    return std::abs(flow.linear_scheme_nodes(cells)[cells / 2] - flow.mid_height_velocity());
  };
  // Order 2: the midpoint rule on a rate that goes as z^(5/3), whose next term is of order 1 + 5/3:
  // (1/2)^(2/3) of it decays.
  CHECK(std::log2(error(160) / error(320)) == Approx(2.0).margin(0.02));
  CHECK_THROWS_AS(SteadyChannel(kHeight, kForce, kPlate, curve).linear_scheme_nodes(10),
                  std::invalid_argument);
}

TEST_CASE("steady channel: what cannot flow is refused") {
  CHECK_THROWS_WITH(SteadyChannel(0.0, kForce, 0.0, NewtonianCurve{1e-6}), contains("height"));
  CHECK_THROWS_WITH(SteadyChannel(kHeight, kForce, 0.0, CrossCurve{1e-6, 0.0, 1.0, 1.0}),
                    contains("no finite shear rate"));
  CHECK_THROWS_WITH(SteadyChannel(kHeight, 0.0, 1.0, CrossCurve{1e-6, 0.01e-6, 1.0, 2.0}), contains("falls"));
  CHECK_THROWS_WITH(SteadyChannel(kHeight, kForce, 0.0, NewtonianCurve{1e-6}).velocity(2 * kHeight),
                    contains("plates"));
}
