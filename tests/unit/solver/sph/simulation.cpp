#include <cmath>
#include <limits>
#include <numbers>

#include "solver/sph/make_sph_solver.hpp"
#include "solver/sph/stable_sph_step.hpp"
#include "solver/step/time_step.hpp"
#include "tests/catch.hpp"

using namespace mpm;

namespace {

constexpr double height = 1e-3, nu = 1e-6, force = 8e-3;

SphScheme with_sph(SphScheme::Wall wall = SphScheme::Wall::Mirror, double smoothing = 0) {
  SphScheme scheme;
  scheme.wall = wall;
  scheme.smoothing = smoothing;
  return scheme;
}

Scene channel(int across, int along, double sound) {
  Scene scene;
  scene.size = {height * along / across, height};
  scene.cells = {along, across};
  scene.particles_per_cell = {1, 1};
  scene.side(Edge::Bottom) = Side::wall(Vec2::Zero());
  scene.side(Edge::Top) = Side::wall(Vec2::Zero());
  scene.fluid.rheology = Newtonian{1000 * nu};
  scene.fluid.pressure = sound > 0;
  scene.fluid.bulk_modulus = 1000 * sound * sound / 7;
  scene.body_acceleration = [](double) { return Vec2(force, 0); };
  return scene;
}

Scene box(int n, double sound, double mu) {
  Scene scene;
  scene.size = {height, height};
  scene.cells = {n, n};
  scene.particles_per_cell = {1, 1};
  scene.fluid.rheology = Newtonian{mu};
  scene.fluid.pressure = sound > 0;
  scene.fluid.bulk_modulus = 1000 * sound * sound / 7;
  return scene;
}

/// Steady Poiseuille flow by relaxation; error of the particles relative to the maximum.
double steady_error(int across, const SphScheme& scheme) {
  const Scene scene = channel(across, 1, 0);
  const auto simulation = make_sph_solver(scene, scheme, 1);
  const auto segments = plan_segments(sph_time_step(scheme, scene), scene, {1.2});
  const Outcome outcome = run(
      *simulation, segments, [](double) {}, [](double) {});
  REQUIRE(!outcome.breakdown);
  double sum = 0;
  const Particles& particles = simulation->particles();
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double y = particles.position[p].y();
    sum += std::pow(particles.velocity[p].x() - force / (2 * nu) * y * (height - y), 2);
  }
  return std::sqrt(sum / static_cast<double>(particles.size())) / 1e-3;
}

double order(double coarse, double fine, double ratio) {
  return std::log(coarse / fine) / std::log(ratio);
}

}  // namespace

TEST_CASE("SPH between mirrors is second order in the spacing, beside fixed wall particles first", "[sph]") {
  const double p_mirror = order(steady_error(12, with_sph()), steady_error(24, with_sph()), 2);
  CHECK(p_mirror > 1.9);
  CHECK(p_mirror < 2.3);
  const SphScheme morris = with_sph(SphScheme::Wall::Morris);
  const double p_morris = order(steady_error(12, morris), steady_error(24, morris), 2);
  CHECK(p_morris > 0.8);
  CHECK(p_morris < 1.4);
}

TEST_CASE("SPH is second order in the smoothing length", "[sph]") {
  // What the kernel smooths is ~ h^2; at 1.5 and 3 spacings sums over the lattice are integrals to 1e-4.
  const double p = order(steady_error(32, with_sph(SphScheme::Wall::Mirror, 3.0)),
                         steady_error(32, with_sph(SphScheme::Wall::Mirror, 1.5)), 2);
  CHECK(p > 1.8);
  CHECK(p < 2.2);
}

TEST_CASE("SPH conserves mass, and changes momentum by body and wall forces alone", "[sph]") {
  for (const SphScheme::Wall wall : {SphScheme::Wall::Mirror, SphScheme::Wall::Morris})
    for (const SphScheme::Density density : {SphScheme::Density::Continuity, SphScheme::Density::Summation}) {
      SphScheme scheme = with_sph(wall);
      scheme.density = density;
      INFO(name(wall) << " " << name(density));
      Scene scene = channel(12, 10, 0.05);
      scene.seeding.displacement = 0.2;
      scene.fluid.rheology = Cross<SquareRoot>{1e-3, 5e-4, 1.0, {}};
      const auto simulation = make_sph_solver(scene, scheme, 1);
      const Totals before = simulation->totals();
      const Outcome outcome = run(
          *simulation, plan_segments({1e-4}, scene, {0.02}), [](double) {}, [](double) {});
      REQUIRE(!outcome.breakdown);
      const Totals after = simulation->totals();
      CHECK(after.mass == before.mass);
      const double scale = after.mass * force * 0.02;
      CHECK((after.momentum - before.momentum - after.impulse).norm() < 1e-12 * scale);
      CHECK(after.impulse.x() < 0.999 * scale);  // the walls hold back
    }
}

TEST_CASE("SPH gives the same bits on any number of threads", "[sph]") {
  Scene scene = channel(20, 30, 0.05);
  scene.seeding.displacement = 0.3;
  scene.fluid.rheology = PowerLaw{1e-3, 0.8, 1e-2, 10};
  const auto one = make_sph_solver(scene, with_sph(), 1), three = make_sph_solver(scene, with_sph(), 3);
  for (int k = 0; k < 30; ++k) {
    one->advance(k * 5e-5, 5e-5);
    three->advance(k * 5e-5, 5e-5);
  }
  for (std::size_t p = 0; p < one->particles().size(); ++p) {
    REQUIRE(one->particles().velocity[p] == three->particles().velocity[p]);
    REQUIRE(one->particles().density[p] == three->particles().density[p]);
  }
}

TEST_CASE("SPH steps are stable up to the limit that its symbols give, and no further", "[sph]") {
  const auto growth = [](const Scene& scene, double dt, int steps) {
    const auto simulation = make_sph_solver(scene, with_sph(), 1);
    const double before = simulation->totals().kinetic_energy;
    for (int k = 0; k < steps; ++k) simulation->advance(k * dt, dt);
    return simulation->totals().kinetic_energy / before;
  };
  SECTION("viscous") {
    Scene scene = box(16, 0, 1e-3);
    // all waves at once, among them the one that decays fastest
    scene.initial_velocity = [](const Vec2& x) {
      return Vec2(1e-9 * std::sin(1e7 * x.x() * x.x() + 2e4 * x.y()), 0);
    };
    const double h = scene.cell_size(0);
    const double limit = stable_sph_step(with_sph(), scene).viscous * h * h / nu;
    CHECK(growth(scene, 0.97 * limit, 400) < 1);
    CHECK(growth(scene, 1.05 * limit, 400) > 1e3);
  }
  SECTION("acoustic") {
    Scene scene = box(16, 1.0, 0);
    scene.initial_velocity = [](const Vec2& x) {
      return Vec2(1e-12 * std::sin(1e7 * x.x() * x.x() + 2e4 * x.y()), 0);
    };
    const double limit = stable_sph_step(with_sph(), scene).acoustic * scene.cell_size(0);
    CHECK(growth(scene, 0.97 * limit, 400) < 50);  // neutrally stable: energy goes to and fro
    CHECK(growth(scene, 1.06 * limit, 400) > 1e6);
  }
}

TEST_CASE("SPH carries a lattice along without change", "[sph]") {
  Scene scene = box(10, 0.05, 1e-3);
  scene.initial_velocity = [](const Vec2&) { return Vec2(3e-3, -2e-3); };
  const auto simulation = make_sph_solver(scene, with_sph(), 1);
  const Particles seeded = simulation->particles();
  const double dt = 1e-3;
  for (int k = 0; k < 700; ++k) simulation->advance(k * dt, dt);  // 2.1 and 1.4 boxes
  for (std::size_t p = 0; p < seeded.size(); ++p) {
    CHECK((simulation->particles().velocity[p] - Vec2(3e-3, -2e-3)).norm() < 1e-13);
    for (const int axis : {0, 1}) {
      const double moved = simulation->particles().position[p][axis] - seeded.position[p][axis] -
                           0.7 * Vec2(3e-3, -2e-3)[axis];
      CHECK(std::abs(moved - height * std::round(moved / height)) < 1e-13);
    }
  }
}

TEST_CASE("SPH's fitted field is exact for quadratic motion, and refuses walls that are too close", "[sph]") {
  Scene scene = box(12, 0, 1e-3);
  scene.initial_velocity = [](const Vec2& x) { return Vec2(x.x() * x.y(), x.y() * x.y() - 2 * x.x()); };
  const auto simulation = make_sph_solver(scene, with_sph(), 1);
  const Vec2 point(0.43e-3, 0.51e-3);  // far from the sides, where the motion is not periodic
  const Vec2 expected(point.x() * point.y(), point.y() * point.y() - 2 * point.x());
  CHECK((simulation->grid_field({point}, 0).front() - expected).norm() < 1e-15);
  Mat2 gradient;
  gradient << point.y(), point.x(), -2, 2 * point.y();
  CHECK((simulation->grid_gradient({point}, 0).front() - gradient).norm() < 1e-11);
  CHECK_THROWS_AS(make_sph_solver(channel(3, 4, 0), with_sph(), 1), SceneError);
}

TEST_CASE("SPH that blows up along a periodic axis says so", "[sph]") {
  Scene scene = box(16, 0, 1e-3);
  scene.initial_velocity = [](const Vec2&) { return Vec2(1e30, 0); };
  const auto simulation = make_sph_solver(scene, with_sph(), 1);
  simulation->advance(0, 1.0);
  REQUIRE(simulation->breakdown() == "a particle crossed the domain in one step");
}

TEST_CASE("SPH damps what moves along its own wave by nu, and by 4/3 nu with the whole stress", "[sph]") {
  const double k = 2 * std::numbers::pi / height, dt = 1e-3 / (nu * k * k);
  const auto damping = [&](const Rheology& rheology) {
    Scene scene = box(32, 0, 1000 * nu);
    scene.fluid.rheology = rheology;
    scene.initial_velocity = [&](const Vec2& x) { return Vec2(1e-6 * std::sin(k * x.x()), 0); };
    const auto simulation = make_sph_solver(scene, with_sph(), 1);
    const auto amplitude = [&] {
      double sum = 0;
      const Particles& particles = simulation->particles();
      for (std::size_t p = 0; p < particles.size(); ++p)
        sum += particles.velocity[p].x() * std::sin(k * particles.position[p].x());
      return sum;
    };
    const double before = amplitude();
    simulation->advance(0, dt);
    return std::log(before / amplitude()) / (nu * k * k * dt);
  };
  // 32 particles a wave: the sums miss some (2 pi/32)^2 of it.
  CHECK(damping(Newtonian{1000 * nu}) == Approx(1).epsilon(0.04));
  // The same viscosity, by a law that could vary.
  CHECK(damping(Cross<SquareRoot>{1000 * nu, 500 * nu, 1e-9, {}}) == Approx(4.0 / 3).epsilon(0.04));
}
