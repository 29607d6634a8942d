#include <benchmark/benchmark.h>

#include "solver/sph/make_sph_solver.hpp"

// Rates of a step of smoothed particle hydrodynamics in particle-steps a second: Poiseuille flow with 40
// particles across, as many as the paper's scene has.

namespace {

constexpr double height = 1e-3, mu_0 = 1e-3, dt = 5e-6;
constexpr int across = 40;

/// Arguments: particles (40 a column), threads.
void sph_step(benchmark::State& state, mpm::SphScheme::Wall wall, const mpm::Rheology& rheology) {
  const int along = static_cast<int>(state.range(0)) / across;
  mpm::Scene scene;
  scene.size = {height / across * along, height};
  scene.cells = {along, across};
  scene.particles_per_cell = {1, 1};
  scene.side(mpm::Edge::Bottom) = scene.side(mpm::Edge::Top) = mpm::Side::wall(mpm::Vec2::Zero());
  scene.body_acceleration = [](double) { return mpm::Vec2(8e-3, 0); };
  scene.fluid.rheology = rheology;
  mpm::SphScheme scheme;
  scheme.wall = wall;
  const auto simulation = mpm::make_sph_solver(scene, scheme, static_cast<int>(state.range(1)));
  double t = 0;
  for (auto _ : state) {
    simulation->advance(t, dt);
    t += dt;
  }
  state.counters["particle-steps"] = benchmark::Counter(static_cast<double>(simulation->particles().size()),
                                                        benchmark::Counter::kIsIterationInvariantRate);
}

using Wall = mpm::SphScheme::Wall;

}  // namespace

BENCHMARK_CAPTURE(sph_step, mirror_newtonian, Wall::Mirror, mpm::Newtonian{mu_0})
    ->Args({800, 1})
    ->Args({80'000, 1});
BENCHMARK_CAPTURE(sph_step, morris_newtonian, Wall::Morris, mpm::Newtonian{mu_0})->Args({800, 1});
BENCHMARK_CAPTURE(sph_step, mirror_power_law, Wall::Mirror, mpm::PowerLaw{mu_0, 0.8, 1e-3, 0})
    ->Args({800, 1});
