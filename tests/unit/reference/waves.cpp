#include <array>
#include <cmath>
#include <numbers>

#include "reference/waves/acoustic_wave.hpp"
#include "reference/waves/shear_wave.hpp"
#include "tests/catch.hpp"

using namespace reference;
using std::numbers::pi;

namespace {

// Sixth-order central first derivative.
template <class F>
double slope(F f, double x, double s) {
  return (45 * (f(x + s) - f(x - s)) - 9 * (f(x + 2 * s) - f(x - 2 * s)) + (f(x + 3 * s) - f(x - 3 * s))) /
         (60 * s);
}

}  // namespace

TEST_CASE("acoustic wave: momentum and mass balance, under-, critically and overdamped") {
  const double c = tait_sound_speed(143.0, 1000.0), k = 2 * pi / 1e-3, rho0 = 1000.0, amplitude = 1e-4;
  CHECK(c == Approx(1.0005).epsilon(1e-4));
  const double critical = 1.5 * c / k;  // (2/3) nu k^2 = c k
  const double nu = critical * GENERATE(0.0, 0.01, 0.5, 0.999999, 1.0, 1.000001, 3.0, 40.0);
  const AcousticWave wave({amplitude, k, 0.3, c, nu, rho0});
  const double unit = 1.0 / (c * k), s = 0.01 * std::min(unit, unit * critical / std::max(nu, critical));
  for (double t : {0.5 * unit, 2.0 * unit, 7.0 * unit}) {
    for (double x : {0.0, 0.11e-3, 0.7e-3}) {
      const auto velocity_slope = [&](double at) {
        return slope([&](double z) { return wave.velocity(z, t); }, at, 0.01 / k);
      };
      const double u_t = slope([&](double r) { return wave.velocity(x, r); }, t, s);
      const double rho_t = slope([&](double r) { return wave.density_perturbation(x, r); }, t, s);
      const double rho_x = slope([&](double z) { return wave.density_perturbation(z, t); }, x, 0.01 / k);
      const double u_xx = slope(velocity_slope, x, 0.01 / k);
      // Step 0.01 of the scale: truncation 1e-12/140 times, round-off 1e-16/0.01 (squared for u_xx), so 1e-9
      // is wide; the viscous term is up to nu/critical times larger than the others.
      const double scale = amplitude * c * k * std::max(1.0, nu / critical);
      CHECK(std::abs(u_t + c * c / rho0 * rho_x - 4.0 / 3.0 * nu * u_xx) < 1e-9 * scale);
      CHECK(std::abs(rho_t + rho0 * velocity_slope(x)) < 1e-9 * rho0 * amplitude * k);
    }
  }
  CHECK(wave.velocity(0.2e-3, 0.0) == Approx(amplitude * std::sin(k * 0.2e-3 + 0.3)).epsilon(1e-14));
  CHECK(wave.density_perturbation(0.2e-3, 0.0) == 0.0);
  CHECK(wave.damping_rate() == Approx(2.0 / 3.0 * nu * k * k));
}

TEST_CASE("acoustic wave: frequency, period and decay over a period") {
  const AcousticWave wave({1e-4, 3e3, pi / 2, 1.0, 5e-5, 1000.0});
  const double period = wave.period(), g = wave.damping_rate();
  CHECK(wave.angular_frequency() == Approx(std::sqrt(9e6 - g * g)).epsilon(1e-14));
  CHECK(wave.velocity(0.0, period) == Approx(1e-4 * std::exp(-g * period)).epsilon(1e-12));

  const AcousticWave over({1e-4, 3e3, 0.0, 1.0, 1.0, 1000.0});
  CHECK(over.angular_frequency() == 0.0);
  CHECK(std::isinf(over.period()));
  CHECK(std::isfinite(over.velocity(1e-3, 1e3)));

  // No damping, no loss: exact return after one period.
  const AcousticWave ideal({1e-4, 3e3, 0.7, 1.0, 0.0, 1000.0});
  CHECK(ideal.velocity(1e-4, 10 * ideal.period()) == Approx(ideal.velocity(1e-4, 0.0)).epsilon(1e-13));
}

TEST_CASE("shear wave: decays as it should, along any direction, carried by any stream") {
  const ShearWave plain({0.2, {0.0, 7.0}, 0.01, {0.0, 0.0}});
  CHECK(plain.velocity(5.0, 0.1, 2.0)[0] ==
        Approx(0.2 * std::sin(0.7) * std::exp(-0.01 * 49 * 2)).epsilon(1e-14));
  CHECK(plain.velocity(5.0, 0.1, 2.0)[1] == 0.0);

  const double nu = 0.02;
  const std::array<double, 2> k{3.0, -5.0}, stream{0.4, 0.9};
  const ShearWave wave({0.2, k, nu, stream});
  CHECK(wave.decay_rate() == Approx(nu * 34.0));
  const double s = 0.01;
  for (double t : {0.0, 0.3, 1.7}) {
    for (const std::array<double, 2>& at : {std::array{0.1, 0.2}, std::array{-0.7, 1.3}}) {
      const double x = at[0], y = at[1];
      const auto v = wave.velocity(x, y, t);
      double divergence = 0.0;
      for (int i = 0; i < 2; ++i) {
        const auto along_x = [&](double z) { return wave.velocity(z, y, t)[i]; };
        const auto along_y = [&](double z) { return wave.velocity(x, z, t)[i]; };
        const auto v_x = [&](double z) { return slope(along_x, z, s); };
        const auto v_y = [&](double z) { return slope(along_y, z, s); };
        const double v_t = slope([&](double r) { return wave.velocity(x, y, r)[i]; }, t, s);
        divergence += i == 0 ? v_x(x) : v_y(y);
        // Navier-Stokes without pressure; truncation (5 s)^6/140 = 1e-10 relative to terms of size 1.
        CHECK(std::abs(v_t + v[0] * v_x(x) + v[1] * v_y(y) - nu * (slope(v_x, x, s) + slope(v_y, y, s))) <
              1e-8);
      }
      CHECK(std::abs(divergence) < 1e-9);
      const double crest = 0.2 * std::exp(-wave.decay_rate() * t);
      CHECK(std::hypot(v[0] - stream[0], v[1] - stream[1]) <= crest * (1 + 1e-14));
    }
  }
}

TEST_CASE("waves: bad arguments are refused") {
  CHECK_THROWS_WITH(AcousticWave({1e-4, 0.0, 0.0, 1.0, 0.0, 1000.0}), contains("wavenumber"));
  CHECK_THROWS_WITH(AcousticWave({1e-4, 1.0, 0.0, 0.0, 0.0, 1000.0}), contains("sound speed"));
  CHECK_THROWS_WITH(AcousticWave({1e-4, 1.0, 0.0, 1.0, -1.0, 1000.0}), contains("viscosity"));
  CHECK_THROWS_WITH(AcousticWave({1e-4, 1.0, 0.0, 1.0, 0.0, 0.0}), contains("density"));
  CHECK_THROWS_WITH(AcousticWave({1e-4, 1.0, 0.0, 1.0, 0.0, 1.0}).velocity(0.0, -1.0), contains("time"));
  CHECK_THROWS_WITH(ShearWave({1.0, {0.0, 0.0}, 0.0, {0.0, 0.0}}), contains("wave vector"));
  CHECK_THROWS_WITH(ShearWave({1.0, {1.0, 0.0}, -1.0, {0.0, 0.0}}), contains("viscosity"));
  CHECK_THROWS_WITH(tait_sound_speed(-1.0, 1000.0), contains("K"));
}
