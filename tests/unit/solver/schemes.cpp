#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/simulation.hpp"
#include "solver/step/time_step.hpp"
#include "tests/catch.hpp"

using namespace mpm;

namespace {

std::vector<Scheme> every_scheme() {
  std::vector<Scheme> schemes;
  for (std::size_t b = 0; b < basis_parts().size(); ++b)
    for (std::size_t t = 0; t < transfer_parts().size(); ++t)
      for (std::size_t s = 0; s < stepping_parts().size(); ++s)
        schemes.push_back({static_cast<Scheme::Basis>(b), static_cast<Scheme::Transfer>(t),
                           static_cast<Scheme::Stepping>(s)});
  return schemes;
}

std::string title(const Scheme& s) {
  return name(s.basis) + " " + name(s.transfer) + " " + name(s.stepping);
}

Scene box(int nx, int ny) {
  Scene scene;
  scene.size = {1e-4 * nx, 1e-4 * ny};
  scene.cells = {nx, ny};
  scene.particles_per_cell = {3, 3};
  scene.fluid.rheology = Newtonian{1e-3};
  return scene;
}

Outcome run_to(Simulation& simulation, const Scene& scene, double dt, double end) {
  return run(
      simulation, plan_segments({dt}, scene, {end}), [](double) {}, [](double) {});
}

/// Couette flow whose upper plate swings: V sin(omega t).
Scene swinging_plate(int cells) {
  Scene scene = box(1, cells);
  const double omega = 300, v = 0.1;
  scene.fluid.pressure = false;
  scene.seeding.rule[1] = Seeding::Rule::Gauss;
  scene.side(Edge::Bottom) = Side::wall(Vec2::Zero());
  Side& top = scene.side(Edge::Top);
  top.periodic = false;
  top.velocity = [=](double t) { return Vec2(v * std::sin(omega * t), 0); };
  top.acceleration = [=](double t) { return Vec2(v * omega * std::cos(omega * t), 0); };
  return scene;
}

/// Observed order in time from three runs that halve dt.
double time_order(const Scene& scene, const Scheme& scheme, double dt, double end) {
  std::vector<VectorField> fields;
  const VectorField points = cell_corners(scene);
  for (int level = 0; level < 3; ++level) {
    const auto simulation = make_simulation(scene, scheme);
    REQUIRE_FALSE(run_to(*simulation, scene, dt / (1 << level), end).breakdown);
    fields.push_back(simulation->grid_field(points, end));
  }
  const auto difference = [&](std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) sum += (fields[a][i] - fields[b][i]).squaredNorm();
    return std::sqrt(sum);
  };
  return std::log2(difference(0, 1) / difference(1, 2));
}

}  // namespace

TEST_CASE("every scheme: rigid translation, particles on edges included, sees no stress") {
  const Vec2 velocity(0.02, -0.013);
  for (const Scheme& scheme : every_scheme()) {
    INFO(title(scheme));
    Scene scene = box(4, 3);
    scene.initial_velocity = [=](const Vec2&) { return velocity; };
    const auto simulation = make_simulation(scene, scheme);
    // 33 um are the spacing: after 100 steps of 0.2 um whole rows have met edges.
    REQUIRE_FALSE(run_to(*simulation, scene, 1e-5, 1e-3).breakdown);
    const Particles& p = simulation->particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
      REQUIRE((p.velocity[i] - velocity).norm() < 1e-13 * velocity.norm());  // round-off of 100 steps
      REQUIRE(std::abs(p.density[i] / 1000 - 1) < 1e-13);
      REQUIRE(p.stress[i].norm() < 1e-9);  // K = 143 Pa times the round-off of the density, times 7
    }
  }
}

TEST_CASE("every scheme: momentum changes by the impulse of body and walls") {
  for (const Scheme& scheme : every_scheme()) {
    INFO(title(scheme));
    Scene scene = box(3, 5);
    scene.particles_per_cell = {3, 4};
    scene.side(Edge::Bottom) = Side::wall(Vec2::Zero());
    scene.side(Edge::Top) = Side::wall(Vec2(0.02, 0));
    scene.body_acceleration = [](double t) { return Vec2(3 + 100 * t, 0); };
    const auto simulation = make_simulation(scene, scheme);
    const Totals begin = simulation->totals();
    REQUIRE_FALSE(run_to(*simulation, scene, 1e-5, 2e-3).breakdown);
    const Totals end = simulation->totals();
    const Vec2 change = end.momentum - begin.momentum, impulse = end.impulse - begin.impulse;
    // Sums of 200 steps and 180 particles: round-off, and that of the linear solvers (1e-12 in the implicit).
    CHECK((change - impulse).norm() < 1e-10 * end.momentum.norm());
    CHECK(end.mass == begin.mass);
  }
}

TEST_CASE("every scheme: the grid field carries the walls' velocity") {
  for (const Scheme& scheme : every_scheme()) {
    INFO(title(scheme));
    Scene scene = box(2, 4);
    scene.side(Edge::Bottom) = Side::wall(Vec2(-0.3, 0));
    scene.side(Edge::Top) = Side::wall(Vec2(0.2, 0));
    const auto simulation = make_simulation(scene, scheme);
    const VectorField field = simulation->grid_field(cell_corners(scene), 0);
    CHECK((field.front() - Vec2(-0.3, 0)).norm() < 1e-15);
    CHECK((field.back() - Vec2(0.2, 0)).norm() < 1e-15);
  }
}

TEST_CASE("second-order steppers keep their order when the wall moves") {
  using S = Scheme;
  const Scene scene = swinging_plate(8);
  // Higher terms, ~ omega dt = 0.03, move the observed order by less than 0.05 (measured 1.997 to 2.043).
  for (const S::Basis basis : {S::Basis::Linear, S::Basis::Quadratic, S::Basis::Cubic}) {
    INFO(name(basis));
    CHECK(time_order(scene, {basis, S::Transfer::FullMass, S::Stepping::Leapfrog}, 1e-4, 8e-3) ==
          Approx(2).margin(0.05));
    CHECK(time_order(scene, {basis, S::Transfer::FullMass, S::Stepping::ImplicitSdirk2}, 1e-4, 8e-3) ==
          Approx(2).margin(0.05));
    CHECK(time_order(scene, {basis, S::Transfer::FullMass, S::Stepping::ImplicitEuler}, 1e-4, 8e-3) ==
          Approx(1).margin(0.05));
  }
  for (const S::Transfer transfer : {S::Transfer::Flip, S::Transfer::Apic}) {
    INFO(name(transfer));
    CHECK(time_order(scene, {S::Basis::Linear, transfer, S::Stepping::Leapfrog}, 1e-4, 8e-3) ==
          Approx(2).margin(0.05));
  }
}

TEST_CASE("the leapfrog is second order for sound, viscosity and moving particles together") {
  Scene scene = box(8, 8);
  const double k = 2 * std::numbers::pi / scene.size.x();
  scene.initial_velocity = [=](const Vec2& x) {  // a vortex, not in balance with its pressure
    return Vec2(0.05 * std::sin(k * x.x()) * std::cos(k * x.y()),
                -0.05 * std::cos(k * x.x()) * std::sin(k * x.y()) + 0.02 * std::sin(k * x.y()));
  };
  // Higher terms: omega dt = 0.16 for sound of this wavelength (measured 1.99 to 2.02).
  CHECK(time_order(scene, {Scheme::Basis::Cubic, Scheme::Transfer::FullMass, Scheme::Stepping::Leapfrog},
                   2e-5, 3.2e-4) == Approx(2).margin(0.05));
  CHECK(time_order(scene,
                   {Scheme::Basis::Cubic, Scheme::Transfer::FullMass, Scheme::Stepping::ImplicitSdirk2}, 2e-5,
                   3.2e-4) == Approx(2).margin(0.05));
}

TEST_CASE("without viscosity the leapfrog holds a sound wave's energy at practical steps") {
  Scene scene = box(16, 1);
  scene.fluid.rheology = Newtonian{0};
  const double k = 2 * std::numbers::pi / scene.size.x(), c = scene.fluid.sound_speed();
  scene.initial_velocity = [=](const Vec2& x) { return Vec2(1e-6 * std::sin(k * x.x()), 0); };
  const Scheme scheme{Scheme::Basis::Quadratic, Scheme::Transfer::FullMass, Scheme::Stepping::Leapfrog};
  const auto simulation = make_simulation(scene, scheme);
  const double begin = simulation->totals().kinetic_energy;
  const double period = scene.size.x() / c;
  REQUIRE_FALSE(run_to(*simulation, scene, 0.3e-4 / c, 50 * period).breakdown);  // c dt/h = 0.3
  // After whole periods the energy is kinetic again; a phase error of 1e-3 a period, 50 periods, leaves
  // cos^2(0.05) = 0.997, and Runge-Kutta of second order would have grown the shortest wave without bound.
  CHECK(simulation->totals().kinetic_energy / begin == Approx(1).margin(0.01));
}

TEST_CASE("names and descriptions of every part, and back") {
  for (const Scheme& scheme : every_scheme()) {
    CHECK(basis_named(name(scheme.basis)) == scheme.basis);
    CHECK(transfer_named(name(scheme.transfer)) == scheme.transfer);
    CHECK(stepping_named(name(scheme.stepping)) == scheme.stepping);
    CHECK(formal_order(scheme).space >= 1);
  }
  for (const auto* parts : {&basis_parts(), &transfer_parts(), &stepping_parts()})
    for (const SchemePart& part : *parts) CHECK_FALSE(part.description.empty());
  CHECK_THROWS_WITH(transfer_named("fip"), contains("flip, pic, flip-blend, apic, full-mass"));
  Scheme blend;
  blend.flip_fraction = 1.5;
  CHECK_THROWS_WITH(make_simulation(box(2, 2), blend), contains("flip_fraction"));
}
