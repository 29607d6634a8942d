#include <benchmark/benchmark.h>

#include "solver/simulation.hpp"

namespace {

/// The paper's Poiseuille scene: 20 cells across, 2 x 2 particles a cell; `cells_along` sets the number of
/// particles.
mpm::Scene paper_scene(int cells_along, bool pressure) {
  constexpr double height = 1e-3;
  mpm::Scene scene;
  scene.size = {height / 20 * cells_along, height};
  scene.cells = {cells_along, 20};
  scene.side(mpm::Edge::Bottom) = scene.side(mpm::Edge::Top) = mpm::Side::wall(mpm::Vec2::Zero());
  scene.body_acceleration = [](double) { return mpm::Vec2(8e-3, 0); };
  scene.fluid.pressure = pressure;
  scene.fluid.rheology = mpm::Newtonian{1e-3};
  return scene;
}

void step(benchmark::State& state, mpm::Scheme::Stepping stepping, bool pressure) {
  const mpm::Scene scene = paper_scene(static_cast<int>(state.range(0)), pressure);
  mpm::Scheme scheme;
  scheme.stepping = stepping;
  const auto simulation = mpm::make_simulation(scene, scheme);
  constexpr double dt = 5e-6;
  double t = 0;
  for (auto _ : state) {
    simulation->advance(t, dt);
    t += dt;
  }
  state.counters["particles"] = static_cast<double>(simulation->particles().size());
  state.counters["particle_steps_per_s"] = benchmark::Counter(
      static_cast<double>(simulation->particles().size()), benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

BENCHMARK_CAPTURE(step, usf, mpm::Scheme::Stepping::Usf, true)->Arg(10)->Arg(125)->Arg(1250);
BENCHMARK_CAPTURE(step, usf_no_pressure, mpm::Scheme::Stepping::Usf, false)->Arg(1)->Arg(10);
BENCHMARK_CAPTURE(step, usl, mpm::Scheme::Stepping::Usl, true)->Arg(10);
BENCHMARK_CAPTURE(step, musl, mpm::Scheme::Stepping::Musl, true)->Arg(10);

BENCHMARK_MAIN();
