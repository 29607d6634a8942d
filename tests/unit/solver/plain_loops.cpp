#include "tests/bench/plain/plain_loop.hpp"
#include "tests/bench/vortices.hpp"
#include "tests/catch.hpp"

using namespace mpm;

namespace {

/// Largest distance of velocities and of positions, over the largest of each.
template <class Loop>
double difference_from_plain(const Scheme& scheme) {
  constexpr int cells = 12, steps = 100;
  const Scene scene = bench::vortices(cells);
  const auto simulation = make_simulation(scene, scheme);
  auto loop = bench::plain_loop<Loop>(cells, simulation->particles());
  const double dt = bench::sonic_step(cells);
  for (int k = 0; k < steps; ++k) {
    simulation->advance(k * dt, dt);
    loop.step(dt);
  }
  const Particles& p = simulation->particles();
  double most = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (int c : {0, 1})
      most = std::max({most, std::abs(loop.points()[i].v[c] - p.velocity[i][c]),
                       std::abs(loop.points()[i].x[c] - p.position[i][c])});
  return most;
}

}  // namespace

TEST_CASE("the benchmark's plain loop gives the solver's answer") {
  const auto agree = [](const auto& viscosity, const Rheology& rheology) {
    Scene scene;
    scene.size = {0.5e-3, 1e-3};
    scene.cells = {10, 20};
    scene.side(Edge::Bottom) = scene.side(Edge::Top) = Side::wall(Vec2::Zero());
    scene.body_acceleration = [](double) { return Vec2(8e-3, 0); };
    scene.fluid.rheology = rheology;
    const auto simulation = make_simulation(scene, {});
    plain::Loop loop({0.5e-3, 1e-3, 10, 20, 2, 1000, 143, 8e-3, true}, viscosity);
    for (int k = 0; k < 2000; ++k) {
      simulation->advance(k * 5e-6, 5e-6);
      loop.step(5e-6);
    }
    const Particles& p = simulation->particles();
    double velocity = 0, position = 0, fastest = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto& q = loop.particles()[i];
      fastest = std::max(fastest, p.velocity[i].norm());
      velocity = std::max(velocity, (p.velocity[i] - Vec2(q.u, q.v)).norm());
      position = std::max(position, (p.position[i] - Vec2(q.x, q.y)).norm());
    }
    // Round-off of 2,000 steps.
    CHECK(velocity < 1e-11 * fastest);
    CHECK(position < 1e-11 * scene.size.norm());
  };
  agree(plain::Newtonian{1e-3}, Newtonian{1e-3});
  agree(plain::Cross{1e-3, 0.5e-3, 1}, Cross<SquareRoot>{1e-3, 0.5e-3, 1, {}});
  agree(plain::PowerLaw{1e-3, 0.8, 1e-3}, PowerLaw{1e-3, 0.8, 1e-3, 0});
}

// Velocities and box are of size 1; round-off of 100 steps in which sound crosses the box twice.
TEST_CASE("the benchmark's plain loops of vortices give the solver's answer") {
  CHECK(difference_from_plain<plain::Apic>(
            {Scheme::Basis::Quadratic, Scheme::Transfer::Apic, Scheme::Stepping::Usf}) < 1e-11);
  CHECK(difference_from_plain<plain::FullMass>(
            {Scheme::Basis::Cubic, Scheme::Transfer::FullMass, Scheme::Stepping::Leapfrog}) < 1e-11);
}
