#include <cmath>
#include <numbers>

#include "reference/surface/gravity_current.hpp"
#include "reference/surface/gravity_wave.hpp"
#include "tests/catch.hpp"

using namespace reference;

TEST_CASE("gravity current: constants of the front") {
  // n, xi_N, I, exponent: quadrature and shooting, independent of the closed forms here.
  const double table[][4] = {{0.25, 1.249199794, 0.7304269991, 1.0 / 14},
                             {0.5, 1.335663484, 0.777612464, 1.0 / 8},
                             {0.8, 1.389942289, 0.819585277, 4.0 / 23},
                             {1, 1.411244774, 0.8413092632, 1.0 / 5},
                             {1.5, 1.439527509, 0.881131265, 1.0 / 4}};
  for (const auto& [n, front, fullness, exponent] : table) {
    INFO("n = " << n);
    CHECK(GravityCurrent::front_constant(n) == Approx(front).epsilon(1e-9));
    CHECK(GravityCurrent::fullness(n) == Approx(fullness).epsilon(1e-9));
    CHECK(GravityCurrent::exponent(n) == Approx(exponent).epsilon(1e-12));
  }
}

TEST_CASE("gravity current: the layer keeps its area and obeys its equation") {
  const double n = GENERATE(0.5, 1.0, 1.5), t = 3;
  GravityCurrentParameters p{2.0, 9.81, 0.7, n};
  const GravityCurrent current(p);
  const double end = current.front(t), c = n / (2 * n + 1) * std::pow(p.gravity / p.consistency, 1 / n);
  double area = 0;
  constexpr int points = 20000;
  for (int i = 0; i < points; ++i) area += current.height((i + 0.5) / points * end, t) * end / points;
  CHECK(area == Approx(p.area).epsilon(1e-5));
  CHECK(current.height(1.01 * end, t) == 0);
  const double d = 1e-4, x = 0.6 * end;
  const auto flux = [&](double at) {
    const double slope = (current.height(at + d, t) - current.height(at - d, t)) / (2 * d);
    return c * std::pow(current.height(at, t), 2 + 1 / n) * std::pow(std::abs(slope), 1 / n);
  };
  const double change = (current.height(x, t + d) - current.height(x, t - d)) / (2 * d);
  CHECK(change == Approx(-(flux(x + d) - flux(x - d)) / (2 * d)).epsilon(1e-5));
  CHECK(GravityCurrent::gravity_of(end, t, p) == Approx(p.gravity).epsilon(1e-12));
  CHECK_THROWS_AS(GravityCurrent({0, 1, 1, 1}), std::invalid_argument);
  CHECK_THROWS_AS(current.front(0), std::invalid_argument);
}

TEST_CASE("gravity wave: Lamb's damping and frequency at small viscosity") {
  const double k = 2 * std::numbers::pi, g = 9.81;
  for (const double depth : {0.1, 0.5, 3.0}) {
    const GravityWave wave({k, depth, g, 1e-6});
    INFO("depth " << depth);
    CHECK(wave.rate().imag() == Approx(std::sqrt(g * k * std::tanh(k * depth))).epsilon(1e-5));
    CHECK(wave.rate().real() == Approx(-2e-6 * k * k).epsilon(2e-2));  // next: O(sqrt(nu k^2/omega))
  }
  CHECK(GravityWave({k, 1, g, 0}).rate().real() == 0);
}

TEST_CASE("gravity wave: infinite depth obeys Lamb's equation, and a thick fluid does not oscillate") {
  const double k = 2, g = 10, nu = 0.05;
  const GravityWave wave({k, 40, g, nu});
  const std::complex<double> s = wave.rate(), m = std::sqrt(k * k + s / nu);
  const auto left = (s + 2 * nu * k * k) * (s + 2 * nu * k * k) + g * k;
  CHECK(std::abs(left - 4 * nu * nu * k * k * k * m) < 1e-9 * g * k);
  CHECK_THROWS_AS(GravityWave({k, 1, g, 10}), std::invalid_argument);
  CHECK_THROWS_AS(GravityWave({k, -1, g, 0.1}), std::invalid_argument);
}

TEST_CASE(
    "gravity wave: its velocity has no divergence, slips along the bottom and starts from a level surface") {
  const double k = 2 * std::numbers::pi, depth = 0.4, d = 1e-5, nu = GENERATE(0.0, 1e-2);
  const GravityWave wave({k, depth, 9.81, nu});
  const auto u = [&](double x, double y) { return wave.velocity(0.1, x, y, 0.3).u; };
  const auto v = [&](double x, double y) { return wave.velocity(0.1, x, y, 0.3).v; };
  const double x = 0.15, y = 0.3;
  const double slope_x = (u(x + d, y) - u(x - d, y)) / (2 * d),
               slope_y = (v(x, y + d) - v(x, y - d)) / (2 * d);
  CHECK(std::abs(slope_x + slope_y) < 1e-7 * std::abs(slope_x));
  CHECK(v(x, 0) == Approx(0).margin(1e-15));
  CHECK(std::abs(u(x, d) - u(x, 0)) < 1e-7 * std::abs(u(x, 0)));
  // The displacement after a period is the integral of v over it: small against v/omega, as at t = 0.
  const double period = 2 * std::numbers::pi / wave.rate().imag();
  double rise = 0;
  for (int i = 0; i < 1000; ++i)
    rise += wave.velocity(0.1, 0, depth, (i + 0.5) / 1000 * period).v * period / 1000;
  CHECK(std::abs(rise) < 1e-3 * 0.1 / wave.rate().imag());
}
