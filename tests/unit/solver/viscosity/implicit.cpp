#include <cmath>

#include "solver/material/rheology/power.hpp"
#include "solver/scene/seeding.hpp"
#include "solver/transfer/transfer.hpp"
#include "solver/viscosity/viscous_newton.hpp"
#include "tests/catch.hpp"

using namespace mpm;

namespace {

/// mu = consistency gdot^(n-1), unbounded at rest for n < 1.
struct TestPowerLaw {
  static constexpr bool needs_shear_rate = true;
  double consistency, n;
  template <class Real>
  [[nodiscard]] Real viscosity(const Real& gdot_squared) const {
    return consistency * RealPower{0.5 * (n - 1)}(gdot_squared);
  }
};

Scene channel(int cells) {
  Scene scene;
  scene.size = {1e-3 / cells, 1e-3};
  scene.cells = {1, cells};
  scene.particles_per_cell = {1, 3};
  scene.seeding.rule[1] = Seeding::Rule::Gauss;
  scene.side(Edge::Bottom) = scene.side(Edge::Top) = Side::wall(Vec2::Zero());
  return scene;
}

/// A channel of fluid on cubic splines with everything that a viscous step needs.
struct Strip {
  using Basis = StripBSpline<3>;

  explicit Strip(const Scene& s)
      : scene(s),
        grid(scene, Basis::degree),
        walls(scene, grid),
        particles(seed_particles(scene)),
        mass(grid, walls) {
    grid.velocity.assign(grid.size(), Vec2::Zero());
    for (std::size_t p = 0; p < particles.size(); ++p)
      FullMass{}.add_momentum<Basis>(Stencil<Basis>(grid, particles.position[p]), particles, p, grid.mass,
                                     grid.velocity);
    table.assign<Basis>(grid, particles);
    mass.assemble<Basis>(table, grid, particles);
    for (std::size_t i = 0; i < grid.size(); ++i) grid.force[i] = grid.mass[i] * Vec2(body, 0);
  }

  ImplicitSolution step(ImplicitViscosity& viscosity, double dt) {
    const VectorField start = grid.velocity;
    return viscosity.solve(table, particles, mass.matrix(grid), start, grid.force, dt, grid.velocity);
  }

  static constexpr double body = 8e-3;
  Scene scene;
  Grid grid;
  WallNodes walls;
  Particles particles;
  ConsistentMass mass;
  StencilTable table;
};

}  // namespace

TEST_CASE("huge implicit steps from rest land on the steady power-law profile") {
  const double n = GENERATE(0.4, 0.6, 1.0, 1.4, 2.0);
  const int cells = 40;
  Strip strip(channel(cells));
  ViscousNewton<TestPowerLaw> viscosity({1e-3, n}, strip.grid, strip.walls);
  const double dt = 1e3;  // a thousand diffusion times
  ImplicitSolution solution{Vec2::Zero(), false};
  for (int step = 0; step < 3; ++step) {
    solution = strip.step(viscosity, dt);
    REQUIRE(solution.converged);
  }
  // u = n/(n+1) (F rho/consistency)^(1/n) (B^(1+1/n) - z^(1+1/n)), z from the centre, B = H/2.
  const double half = 5e-4, slope = std::pow(1000 * Strip::body / 1e-3, 1 / n);
  const auto exact = [&](double z) {
    return n / (n + 1) * slope * (std::pow(half, 1 + 1 / n) - std::pow(z, 1 + 1 / n));
  };
  double most = 0;
  for (int j = 0; j <= cells; ++j) {
    const double y = 1e-3 * j / cells;
    const Vec2 u = interpolate<Strip::Basis>(strip.grid, strip.grid.velocity, {0, y});
    most = std::max(most, std::abs(u.x() - exact(std::abs(y - half))));
    CHECK(std::abs(u.y()) < 1e-12 * exact(0));
  }
  // Error of the mesh at the centre, where the profile is z^(1+1/n) only: largest for n = 2 (measured 7e-4 of
  // the maximum; 1.5e-4 for n = 1.4, 1e-6 for n = 0.4).
  CHECK(most < 1e-3 * exact(0));
  // The walls carry the whole weight, 1000 kg/m3 F H h over both, times dt.
  CHECK(solution.wall_impulse.x() == Approx(-1000 * Strip::body * 1e-3 * 1e-3 / cells * dt).epsilon(1e-6));
}

TEST_CASE("steps of a power law from rest converge at any size, and decay to the same profile") {
  const double n = GENERATE(0.4, 0.6, 1.4, 2.0);
  Strip strip(channel(20));
  ViscousNewton<TestPowerLaw> viscosity({1e-3, n}, strip.grid, strip.walls);
  for (const double dt : {1e-6, 1e-4, 1e-2, 1.0, 1e-3})
    for (int step = 0; step < 5; ++step) {
      INFO("dt = " << dt << ", step " << step);
      REQUIRE(strip.step(viscosity, dt).converged);
    }
}

TEST_CASE("a Newtonian implicit step satisfies M (v - v0) = dt (f - K v) with a constant matrix") {
  Strip strip(channel(10));
  ViscousNewton<Newtonian> viscosity(Newtonian{1e-3}, strip.grid, strip.walls);
  const double dt = 0.01;
  REQUIRE(strip.step(viscosity, dt).converged);
  // The slowest mode alone after long: its amplification is 1/(1 + dt nu pi^2/H^2) per step.
  for (std::size_t i = 0; i < strip.grid.size(); ++i) strip.grid.force[i] = Vec2::Zero();
  double before = 0, after = 0;
  for (int step = 0; step < 100; ++step) {
    before = after;
    REQUIRE(strip.step(viscosity, dt).converged);
    after = interpolate<Strip::Basis>(strip.grid, strip.grid.velocity, {0, 5e-4}).x();
  }
  const double pi = 3.14159265358979323846;
  // Eigenvalue error of cubic splines, (pi/10)^6/30240 with Gauss quadrature: about 1e-7; the odd modes have
  // decayed by ((1 + 0.1)/(1 + 0.9))^100 = 1e-24.
  CHECK(after / before == Approx(1 / (1 + dt * pi * pi)).epsilon(1e-6));
}
