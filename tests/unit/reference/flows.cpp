#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "reference/channel/oscillating_channel.hpp"
#include "reference/compressible/tait_column.hpp"
#include "reference/compressible/translation.hpp"
#include "reference/compressible/uniform_dilatation.hpp"
#include "reference/waves/acoustic_wave.hpp"
#include "reference/waves/shear_wave.hpp"
#include "tests/catch.hpp"

using namespace reference;
using std::numbers::pi;

namespace {

// Sixth-order central differences.
template <class F>
auto slope(F f, double x, double s) {
  return (45.0 * (f(x + s) - f(x - s)) - 9.0 * (f(x + 2 * s) - f(x - 2 * s)) +
          (f(x + 3 * s) - f(x - 3 * s))) /
         (60 * s);
}
template <class F>
auto curvature(F f, double x, double s) {
  return (270.0 * (f(x + s) + f(x - s)) - 27.0 * (f(x + 2 * s) + f(x - 2 * s)) +
          2.0 * (f(x + 3 * s) + f(x - 3 * s)) - 490.0 * f(x)) /
         (180 * s * s);
}

}  // namespace

TEST_CASE("Tait column: weight balances pressure, mass is the integral of density") {
  const double height = 2e-3, c = 1.0005, rho0 = 1000, contrast = GENERATE(0.0, 0.01, 0.08, 0.5);
  const double g = TaitColumn::gravity_of_contrast(contrast, height, c);
  const TaitColumn column({height, g, c, rho0});
  CHECK(column.density(height) == rho0);
  CHECK(column.density(0) == Approx(rho0 * (1 + contrast)).epsilon(1e-14));
  const double K = rho0 * c * c / 7;
  for (const double part : {0.01, 0.2, 0.5, 0.9}) {
    const double y = part * height;
    const double dp = slope([&](double z) { return column.pressure(z); }, y, 1e-3 * height);
    // 1e-9: truncation (1e-3)^6 and round-off 1e-16 K/(1e-3 H) against rho g.
    CHECK(std::abs(dp + column.density(y) * g) < 1e-9 * (rho0 * g + K / height));
    CHECK(column.pressure(y) == Approx(K * (std::pow(column.density(y) / rho0, 7) - 1)).margin(1e-13 * K));
  }
  double mass = 0;
  const int n = 2000;
  for (int j = 0; j < n; ++j) mass += column.density((j + 0.5) * height / n) * height / n;
  CHECK(column.mass() == Approx(mass).epsilon(1e-6 * std::max(contrast, 1e-6)));  // midpoint: (s/n)^2/24 of 1
  if (g > 0)
    CHECK(column.mass() == Approx((column.pressure(0) - column.pressure(height)) / g).epsilon(1e-12));
}

TEST_CASE("Tait column: bad arguments are refused") {
  CHECK_THROWS_WITH(TaitColumn({0, 1, 1, 1}), contains("height"));
  CHECK_THROWS_WITH(TaitColumn({1, -1, 1, 1}), contains("gravity"));
  CHECK_THROWS_WITH(TaitColumn({1, 1, 0, 1}), contains("sound speed"));
  CHECK_THROWS_WITH(TaitColumn({1, 1, 1, NAN}), contains("density"));
  CHECK_THROWS_WITH(TaitColumn::gravity_of_contrast(-0.1, 1, 1), contains("contrast"));
}

TEST_CASE("oscillating channel: momentum balance and wall values at any Womersley number") {
  const double height = 1e-3, nu = 1e-6;
  const double number = GENERATE(0.01, 0.5, 1.0, 3.0, 10.0, 40.0, 2000.0);
  const double omega = nu * 4 * number * number / (height * height);
  const double force = 8e-3, plate = 1e-4;
  const OscillatingChannel channel({height, nu, omega, force, plate});
  CHECK(channel.womersley_number() == Approx(number).epsilon(1e-14));
  CHECK(std::abs(channel.amplitude(0)) == 0);
  CHECK(std::abs(channel.amplitude(height) - plate) < 1e-19);
  const double delta = std::min(height, std::sqrt(2 * nu / omega));
  for (const double part : {0.3, 1.7, 6.0}) {
    const double y = part * delta / 8;
    const auto u = [&](double at) { return channel.amplitude(at); };
    const auto residual = std::complex<double>(0, omega) * u(y) - force - nu * curvature(u, y, 0.01 * delta);
    // Round-off 490/180 1e-16 |U|/(0.01 delta)^2 and truncation (0.01)^6, of the largest term.
    const double scale = force + (omega + nu / (delta * delta)) * (plate + force / omega * number);
    CHECK(std::abs(residual) < 1e-9 * std::max(scale, force));
  }
  const double t = 0.37 / omega, dt = 0.01 / omega, y = 0.41 * height;
  const double u_t = slope([&](double s) { return channel.velocity(y, s); }, t, dt);
  CHECK(u_t ==
        Approx((std::complex<double>(0, omega) * channel.amplitude(y) * std::polar(1.0, omega * t)).real())
            .epsilon(1e-9)
            .margin(1e-14 * omega * plate));
}

TEST_CASE("oscillating channel: slow drives are quasi-steady, fast ones leave Stokes layers") {
  const double height = 1e-3, nu = 1e-6, force = 8e-3, plate = 1e-4;
  const double slow = 1e-6;  // omega H^2/nu = 1e-6: corrections of that size
  const OscillatingChannel steady({height, nu, slow, force, plate});
  for (const double s : {0.1, 0.5, 0.8}) {
    const double poiseuille = force / (2 * nu) * height * height * s * (1 - s);
    CHECK(steady.velocity(s * height, 0) == Approx(poiseuille + plate * s).epsilon(1e-6));
  }
  const double fast = 1e6;  // delta = 1.4e-6 m
  const double delta = std::sqrt(2 * nu / fast);
  const OscillatingChannel layer({height, nu, fast, 0, plate}), bulk({height, nu, fast, force, 0});
  const double depth = 2 * delta;
  CHECK(layer.velocity(height - depth, 0.3 / fast) ==
        Approx(plate * std::exp(-2.0) * std::cos(0.3 - 2)).epsilon(1e-9));
  CHECK(std::abs(layer.amplitude(0.5 * height)) < 1e-100);
  CHECK(std::abs(bulk.amplitude(0.5 * height) - std::complex<double>(0, -force / fast)) <
        1e-14 * force / fast);
}

TEST_CASE("oscillating channel: bad arguments are refused") {
  CHECK_THROWS_WITH(OscillatingChannel({0, 1, 1, 1, 0}), contains("height"));
  CHECK_THROWS_WITH(OscillatingChannel({1, 0, 1, 1, 0}), contains("viscosity"));
  CHECK_THROWS_WITH(OscillatingChannel({1, 1, 0, 1, 0}), contains("frequency"));
  CHECK_THROWS_WITH(OscillatingChannel({1, 1, 1, 0, 0}), contains("drives"));
  CHECK_THROWS_WITH(OscillatingChannel({1, 1, 1, 1, 0}).amplitude(2), contains("gap"));
}

TEST_CASE("uniform dilatation: mass balance, free flight, and the Euler update that it makes exact") {
  const double rate = GENERATE(-100.0, 40.0), rho0 = 900;
  const UniformDilatation flow({rate, rho0});
  const double t = 2e-3, x = 0.3e-3, s = 1e-5;
  const double rho_t = slope([&](double r) { return flow.density(r); }, t, s);
  const double u_x = slope([&](double z) { return flow.velocity(z, t); }, x, 1e-5);
  CHECK(rho_t == Approx(-flow.density(t) * u_x).epsilon(1e-10));
  const double u_t = slope([&](double r) { return flow.velocity(x, r); }, t, s);
  CHECK(std::abs(u_t + flow.velocity(x, t) * u_x) < 1e-9 * std::abs(u_t));
  CHECK(flow.density(t + s) == Approx(flow.density(t) / (1 + s * u_x)).epsilon(1e-13));
  CHECK_THROWS_WITH(UniformDilatation({-100, 1}).density(0.011), contains("collapse"));
  CHECK_THROWS_WITH(UniformDilatation({1, 0}), contains("density"));
}

TEST_CASE("translation wraps, and the path of a shear wave follows its velocity") {
  const Translation translation{{3, -2}, {1, 0.5}};
  const auto x = translation.position({0.25, 0.125}, 1.5);
  CHECK(x[0] == Approx(0.75).epsilon(1e-14));
  CHECK(x[1] == Approx(0.125).epsilon(1e-14));
  CHECK(wrapped(-0.25, 1) == 0.75);

  for (const double nu : {0.0, 0.02}) {
    const ShearWave wave({0.2, {3.0, -5.0}, nu, {0.4, 0.9}});
    for (const double t : {0.0, 0.7}) {
      for (const std::size_t i : {0u, 1u}) {
        const auto at = wave.path(0.1, 0.2, t);
        const double moved = slope([&](double s) { return wave.path(0.1, 0.2, s)[i]; }, t, 0.01);
        CHECK(moved == Approx(wave.velocity(at[0], at[1], t)[i]).epsilon(1e-10));
      }
    }
    CHECK(wave.path(0.1, 0.2, 0) == std::array{0.1, 0.2});
  }
}
