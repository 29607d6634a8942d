#include <benchmark/benchmark.h>

#include "solver/kernel/isa.hpp"
#include "solver/simulation.hpp"
#include "tests/bench/plain/plain_loop.hpp"

// Rates of a step in particle-steps a second: the solver and, in the same run, the plain loop that it is
// measured against.

namespace {

constexpr double height = 1e-3, dt = 5e-6;
constexpr double mu_0 = 1e-3, mu_inf = 0.5e-3, time_constant = 1, flow_index = 0.8, rate_floor = 1e-3;

enum Fluid { Newtonian, Cross, PowerLaw };

mpm::Rheology rheology(Fluid fluid) {
  if (fluid == Cross) return mpm::Cross<mpm::SquareRoot>{mu_0, mu_inf, time_constant, {}};
  if (fluid == PowerLaw) return mpm::PowerLaw{mu_0, flow_index, rate_floor, 0};
  return mpm::Newtonian{mu_0};
}

/// The paper's Poiseuille scene: 20 cells across, 2 x 2 particles a cell; `cells_along` sets the number of
/// particles.
mpm::Scene paper_scene(int cells_along, Fluid fluid, bool pressure) {
  mpm::Scene scene;
  scene.size = {height / 20 * cells_along, height};
  scene.cells = {cells_along, 20};
  scene.side(mpm::Edge::Bottom) = scene.side(mpm::Edge::Top) = mpm::Side::wall(mpm::Vec2::Zero());
  scene.body_acceleration = [](double) { return mpm::Vec2(8e-3, 0); };
  scene.fluid.pressure = pressure;
  scene.fluid.rheology = rheology(fluid);
  return scene;
}

void count(benchmark::State& state, std::size_t particles) {
  state.counters["particle-steps"] =
      benchmark::Counter(static_cast<double>(particles), benchmark::Counter::kIsIterationInvariantRate);
}

/// Arguments: particles (80 a column of cells), threads.
void step(benchmark::State& state, const mpm::Scheme& scheme, Fluid fluid, bool pressure) {
  const mpm::Scene scene = paper_scene(static_cast<int>(state.range(0)) / 80, fluid, pressure);
  const auto simulation = mpm::make_simulation(scene, scheme, static_cast<int>(state.range(1)));
  double t = 0;
  for (auto _ : state) {
    simulation->advance(t, dt);
    t += dt;
  }
  count(state, simulation->particles().size());
  state.SetLabel(mpm::current_isa());
}

template <class Viscosity>
void plain_step(benchmark::State& state, Viscosity viscosity) {
  const int cells_along = static_cast<int>(state.range(0)) / 80;
  plain::Loop<Viscosity> loop({height / 20 * cells_along, height, cells_along, 20, 2, 1000, 143, 8e-3, true},
                              viscosity);
  for (auto _ : state) loop.step(dt);
  count(state, loop.particles().size());
}

mpm::Scheme scheme(mpm::Scheme::Basis basis, mpm::Scheme::Stepping stepping = mpm::Scheme::Stepping::Usf) {
  return {basis, mpm::Scheme::Transfer::Flip, stepping};
}

using B = mpm::Scheme::Basis;
using S = mpm::Scheme::Stepping;

constexpr std::int64_t paper = 800;  // particles of the paper's scene
const std::vector<std::vector<std::int64_t>> sizes{{paper, 10'000, 100'000, 1'000'000}, {1}};

}  // namespace

BENCHMARK_CAPTURE(plain_step, newtonian, plain::Newtonian{mu_0})->Arg(paper)->Arg(10'000)->Arg(1'000'000);
BENCHMARK_CAPTURE(step, linear_newtonian, scheme(B::Linear), Newtonian, true)->ArgsProduct(sizes);
BENCHMARK_CAPTURE(plain_step, cross, plain::Cross{mu_0, mu_inf, time_constant})->Arg(paper);
BENCHMARK_CAPTURE(step, linear_cross, scheme(B::Linear), Cross, true)->Args({paper, 1});
BENCHMARK_CAPTURE(plain_step, power_law, plain::PowerLaw{mu_0, flow_index, rate_floor})->Arg(paper);
BENCHMARK_CAPTURE(step, linear_power_law, scheme(B::Linear), PowerLaw, true)->Args({paper, 1});
BENCHMARK_CAPTURE(step, quadratic_newtonian, scheme(B::Quadratic), Newtonian, true)->Args({paper, 1});
BENCHMARK_CAPTURE(step, quadratic_cross, scheme(B::Quadratic), Cross, true)->Args({paper, 1});
BENCHMARK_CAPTURE(step, quadratic_power_law, scheme(B::Quadratic), PowerLaw, true)->Args({paper, 1});
BENCHMARK_CAPTURE(step, cubic_newtonian, scheme(B::Cubic), Newtonian, true)->Args({paper, 1});
BENCHMARK_CAPTURE(step, cubic_cross, scheme(B::Cubic), Cross, true)->Args({paper, 1});
BENCHMARK_CAPTURE(step, cubic_power_law, scheme(B::Cubic), PowerLaw, true)->Args({paper, 1});
BENCHMARK_CAPTURE(step, linear_no_pressure, scheme(B::Linear), Newtonian, false)->Args({paper, 1});
BENCHMARK_CAPTURE(step, linear_usl, scheme(B::Linear, S::Usl), Newtonian, true)->Args({paper, 1});
BENCHMARK_CAPTURE(step, linear_musl, scheme(B::Linear, S::Musl), Newtonian, true)->Args({paper, 1});
// Wall time: with two threads that is what counts. Repeated more often than the rest: on a machine that
// others use, two cores are undisturbed at the same time less often than one.
BENCHMARK_CAPTURE(step, linear_threads, scheme(B::Linear), Newtonian, true)
    ->Args({1'000'000, 1})
    ->Args({1'000'000, 2})
    ->Repetitions(15)
    ->UseRealTime();
