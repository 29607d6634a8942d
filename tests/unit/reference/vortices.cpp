#include <cmath>
#include <limits>
#include <numbers>

#include "reference/vortices/manufactured_flow.hpp"
#include "reference/vortices/smooth_cavity.hpp"
#include "reference/vortices/taylor_green.hpp"
#include "reference/vortices/walled_vortex.hpp"
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

/// Derivatives of a velocity field (x, y, t) -> {u, v} at one place by differences.
template <class Field>
struct Derivatives {
  const Field& field;
  double s, s_t;

  [[nodiscard]] double x(int c, double px, double py, double t) const {
    return slope([&](double z) { return field(z, py, t)[static_cast<std::size_t>(c)]; }, px, s);
  }
  [[nodiscard]] double y(int c, double px, double py, double t) const {
    return slope([&](double z) { return field(px, z, t)[static_cast<std::size_t>(c)]; }, py, s);
  }
  [[nodiscard]] double t(int c, double px, double py, double at) const {
    return slope([&](double z) { return field(px, py, z)[static_cast<std::size_t>(c)]; }, at, s_t);
  }
};

}  // namespace

TEST_CASE("Taylor-Green: the fields satisfy the Navier-Stokes equations") {
  const double amplitude = 0.7, period = 2e-3, density = 900;
  const double nu = amplitude * period / GENERATE(1.0, 10.0, 100.0, 1e9);
  const TaylorGreen vortex({amplitude, period, nu, density});
  const auto velocity = [&](double x, double y, double t) { return vortex.velocity(x, y, t); };
  const double turn = period / amplitude, s = 5e-3 * period;
  const Derivatives<decltype(velocity)> d{velocity, s, 5e-3 * std::min(turn, 1 / vortex.decay_rate())};
  const double unit = amplitude * amplitude / period + nu * amplitude / (period * period);
  for (const double t : {0.0, 0.3 / (vortex.decay_rate() + 1 / turn)})
    for (const double x : {0.0, 0.13 * period, 0.62 * period})
      for (const double y : {0.05 * period, 0.41 * period, 0.9 * period}) {
        // Differences of step 2 pi 0.005 in units of 1/k: truncation 7e-12, round-off 1e-14 each (1e-12 for
        // the second derivative); both grow by the dozen terms and k L = 2 pi squared: 1e-8 is wide.
        CHECK(std::abs(d.x(0, x, y, t) + d.y(1, x, y, t)) < 1e-8 * amplitude / period);
        for (const int c : {0, 1}) {
          const auto v = velocity(x, y, t);
          const double xx = slope([&](double z) { return d.x(c, z, y, t); }, x, s);
          const double yy = slope([&](double z) { return d.y(c, x, z, t); }, y, s);
          const double dp =
              slope([&](double z) { return c == 0 ? vortex.pressure(z, y, t) : vortex.pressure(x, z, t); },
                    c == 0 ? x : y, s);
          const double residual = d.t(c, x, y, t) + v[0] * d.x(c, x, y, t) + v[1] * d.y(c, x, y, t) +
                                  dp / density - nu * (xx + yy);
          CHECK(std::abs(residual) < 1e-7 * unit);
        }
      }
}

TEST_CASE(
    "Taylor-Green: root mean square and kinetic energy are those of the field, pressure has mean zero") {
  const TaylorGreen vortex({1.3, 0.5, 2e-3, 1000});
  const double t = 0.4;
  double squares = 0, pressure = 0;
  const int n = 8;  // a lattice of more than four points a wave sums trigonometric squares exactly
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto v = vortex.velocity((i + 0.3) * 0.5 / n, (j + 0.1) * 0.5 / n, t);
      squares += (v[0] * v[0] + v[1] * v[1]) / (n * n);
      pressure += vortex.pressure((i + 0.3) * 0.5 / n, (j + 0.1) * 0.5 / n, t) / (n * n);
    }
  CHECK(vortex.rms_speed(t) == Approx(std::sqrt(squares)).epsilon(1e-13));
  CHECK(vortex.kinetic_energy(t) == Approx(0.5 * 1000 * 0.25 * squares).epsilon(1e-13));
  CHECK(std::abs(pressure) < 1e-11 * 1000);
}

TEST_CASE("Taylor-Green: bad parameters are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(TaylorGreen({0, 1, 1, 1}), contains("amplitude"));
  CHECK_THROWS_WITH(TaylorGreen({1, -1, 1, 1}), contains("period"));
  CHECK_THROWS_WITH(TaylorGreen({1, 1, nan, 1}), contains("viscosity"));
  CHECK_THROWS_WITH(TaylorGreen({1, 1, 1, 0}), contains("density"));
}

TEST_CASE("manufactured flow: the acceleration balances the momentum equation") {
  ManufacturedParameters p;
  p.height = 0.8;
  p.length = GENERATE(0.8, 1.3);
  p.plate_velocity = 1.1;
  p.amplitude = 0.07;
  p.angular_frequency = 2.5;
  p.curve =
      GENERATE(FlowCurve(NewtonianCurve{0.02}), FlowCurve(CrossCurve{0.02, 0.005, 0.7, 1.0}),
               FlowCurve(CrossCurve{0.02, 0.08, 0.7, 1.4}), FlowCurve(PowerLawCurve{0.03, 0.6}),
               FlowCurve(PowerLawCurve{0.03, 1.4}), FlowCurve(CarreauYasudaCurve{0.02, 0.004, 0.6, 2, 0.5}));
  const ManufacturedFlow flow(p);
  const auto velocity = [&](double x, double y, double t) { return flow.velocity(x, y, t); };
  const double s = 4e-3;
  const Derivatives<decltype(velocity)> d{velocity, s, 1e-3};
  // Stress per density, 2 nu(sqrt(2 D:D)) D, from differences of the velocity.
  const auto stress = [&](int a, int b, double x, double y, double t) {
    const double l[2][2] = {{d.x(0, x, y, t), d.y(0, x, y, t)}, {d.x(1, x, y, t), d.y(1, x, y, t)}};
    double squares = 0;
    for (int i : {0, 1})
      for (int j : {0, 1}) squares += 0.25 * (l[i][j] + l[j][i]) * (l[i][j] + l[j][i]);
    return p.curve.viscosity(std::sqrt(2 * squares)) * (l[a][b] + l[b][a]);
  };
  for (const double t : {0.0, 0.9})
    for (const double x : {0.05, 0.33, 0.7})
      for (const double y : {0.0, 0.11, 0.4, 0.72, 0.8}) {
        const auto b = flow.acceleration(x, y, t);
        const auto v = flow.velocity(x, y, t);
        // Truncation (2 pi s/H)^6/140 = 7e-12, round-off 1e-16/s^2 = 6e-12, of terms up to 100.
        CHECK(std::abs(d.x(0, x, y, t) + d.y(1, x, y, t)) < 1e-9);
        for (const int c : {0, 1}) {
          const double viscous = slope([&](double z) { return stress(c, 0, z, y, t); }, x, s) +
                                 slope([&](double z) { return stress(c, 1, x, z, t); }, y, s);
          const double inertia = d.t(c, x, y, t) + v[0] * d.x(c, x, y, t) + v[1] * d.y(c, x, y, t);
          CHECK(b[static_cast<std::size_t>(c)] == Approx(inertia - viscous).margin(1e-8));
        }
      }
}

TEST_CASE("manufactured flow: no slip on the plates, and shear everywhere") {
  ManufacturedParameters p;
  p.height = 1;
  p.length = GENERATE(1.0, 2.0, 0.6);
  p.plate_velocity = 1;
  p.angular_frequency = 3;
  const double k = 2 * pi / p.length, q = 2 * pi;
  const double most = 1 / std::max(q, std::abs(2 * k * k / q - q));
  p.amplitude = 0.6 * most;
  const ManufacturedFlow flow(p);
  CHECK(flow.least_shear_rate() == Approx(0.4));
  double least = 1e9;
  for (int i = 0; i < 40; ++i) {
    const double x = p.length * i / 40;
    for (const double t : {0.0, 0.31}) {
      CHECK(std::hypot(flow.velocity(x, 0, t)[0], flow.velocity(x, 0, t)[1]) < 1e-15);
      CHECK(std::hypot(flow.velocity(x, 1, t)[0] - 1, flow.velocity(x, 1, t)[1]) < 1e-15);
    }
    for (int j = 0; j <= 40; ++j) {
      const double y = j / 40.0, s = 1e-3;
      const auto part = [&](int c, double dx, double dy) {
        return slope(
            [&](double z) { return flow.velocity(x + z * dx, y + z * dy, 0)[static_cast<std::size_t>(c)]; },
            0, s);
      };
      least = std::min(least, std::hypot(2 * part(0, 1, 0), part(0, 0, 1) + part(1, 1, 0)));
    }
  }
  CHECK(least >= flow.least_shear_rate() * (1 - 1e-9));
  CHECK(least < 1.3 * flow.least_shear_rate());  // the bound is near what is reached: within 30 %
  p.amplitude = 1.01 * most;
  CHECK_THROWS_WITH(ManufacturedFlow(p), contains("shear rate could vanish"));
  p.amplitude = -0.1;
  CHECK_THROWS_WITH(ManufacturedFlow(p), contains("amplitude"));
  p.amplitude = 0.1 * most;
  p.height = 0;
  CHECK_THROWS_WITH(ManufacturedFlow(p), contains("height"));
}

TEST_CASE("walled vortex: no slip, no divergence, and the acceleration balances the momentum equation") {
  const WalledVortex vortex({0.8, 1.1, 0.7, 0.03});
  const auto velocity = [&](double x, double y, double t) { return vortex.velocity(x, y, t); };
  const double s = 4e-3;
  const Derivatives<decltype(velocity)> d{velocity, s, 1e-3};
  for (const double z : {0.0, 0.3, 0.8})
    for (const double wall : {0.0, 0.8}) {
      CHECK(std::hypot(velocity(wall, z, 0.2)[0], velocity(wall, z, 0.2)[1]) < 1e-15);
      CHECK(std::hypot(velocity(z, wall, 0.2)[0], velocity(z, wall, 0.2)[1]) < 1e-15);
    }
  for (const double t : {0.0, 0.9})
    for (const double x : {0.05, 0.33, 0.7})
      for (const double y : {0.11, 0.4, 0.72}) {
        const auto b = vortex.acceleration(x, y, t), v = vortex.velocity(x, y, t);
        // Truncation (2 pi s/L)^6/140 = 7e-12, round-off 1e-16/s^2 = 6e-12, of terms up to 100.
        CHECK(std::abs(d.x(0, x, y, t) + d.y(1, x, y, t)) < 1e-9);
        for (const int c : {0, 1}) {
          const double viscous = 0.03 * (slope([&](double z) { return d.x(c, z, y, t); }, x, s) +
                                         slope([&](double z) { return d.y(c, x, z, t); }, y, s));
          const double inertia = d.t(c, x, y, t) + v[0] * d.x(c, x, y, t) + v[1] * d.y(c, x, y, t);
          CHECK(b[static_cast<std::size_t>(c)] == Approx(inertia - viscous).margin(1e-8));
        }
      }
  double squares = 0;
  const int n = 8;  // a lattice of more than four points a wave sums trigonometric squares exactly
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto v = vortex.velocity((i + 0.5) * 0.8 / n, (j + 0.5) * 0.8 / n, 0.4);
      squares += (v[0] * v[0] + v[1] * v[1]) / (n * n);
    }
  CHECK(vortex.rms_speed(0.4) == Approx(std::sqrt(squares)).epsilon(1e-13));
}

TEST_CASE("cavity under a smooth lid: walls hold, the momentum equation's curl is met, functions converge") {
  const double nu = 0.01;
  const SmoothCavity flow(1 / nu, 16), finer(1 / nu, 20);
  for (const double z : {0.1, 0.5, 0.9}) {
    CHECK(flow.velocity(z, 1)[0] == Approx(16 * z * z * (1 - z) * (1 - z)).epsilon(1e-13));
    for (const auto& v : {flow.velocity(z, 0), flow.velocity(0, z), flow.velocity(1, z)})
      CHECK(std::hypot(v[0], v[1]) < 1e-13);
  }
  const auto velocity = [&](double x, double y, double) { return finer.velocity(x, y); };
  const double s = 4e-3;
  const Derivatives<decltype(velocity)> d{velocity, s, 1};
  const auto vorticity = [&](double x, double y) { return d.x(1, x, y, 0) - d.y(0, x, y, 0); };
  for (const double x : {0.3, 0.6})
    for (const double y : {0.4, 0.7}) {
      CHECK(std::abs(d.x(0, x, y, 0) + d.y(1, x, y, 0)) < 1e-9);
      const auto along_x = [&](double z) { return vorticity(z, y); };
      const auto along_y = [&](double z) { return vorticity(x, z); };
      const auto v = finer.velocity(x, y);
      const double laplacian = slope([&](double z) { return slope(along_x, z, s); }, x, s) +
                               slope([&](double z) { return slope(along_y, z, s); }, y, s);
      // Galerkin's method meets it in the mean: terms of 1 to 10 cancel to what the functions lack.
      CHECK(v[0] * slope(along_x, x, s) + v[1] * slope(along_y, y, s) == Approx(nu * laplacian).margin(5e-3));
      CHECK(std::hypot(v[0] - flow.velocity(x, y)[0], v[1] - flow.velocity(x, y)[1]) < 1e-5);
    }
}
