#include <benchmark/benchmark.h>

#include "solver/incompressible/make_incompressible_solver.hpp"
#include "solver/kernel/isa.hpp"
#include "solver/table/make_solver.hpp"
#include "tests/bench/vortices.hpp"

// Rates of a step of the schemes that are accurate in two dimensions: Taylor-Green vortices in a periodic
// box, Re 100, c = 20 U, by the general solver in the same run, which visits particle by particle; and of the
// implicit rule on a strip.

namespace {

using B = mpm::Scheme::Basis;
using T = mpm::Scheme::Transfer;
using S = mpm::Scheme::Stepping;
using bench::vortices;

/// The channel of the implicit studies: one cell along, three particles a cell across.
mpm::Scene strip(int cells) {
  mpm::Scene scene;
  scene.size = {1e-3 / cells, 1e-3};
  scene.cells = {1, cells};
  scene.particles_per_cell = {1, 3};
  scene.seeding.rule[1] = mpm::Seeding::Rule::Gauss;
  scene.side(mpm::Edge::Bottom) = scene.side(mpm::Edge::Top) = mpm::Side::wall(mpm::Vec2::Zero());
  scene.fluid.pressure = false;
  scene.fluid.rheology = mpm::Newtonian{1e-3};
  scene.body_acceleration = [](double) { return mpm::Vec2(8e-3, 0); };
  return scene;
}

/// Steps that are not timed: the first factorises or makes room, and solves begin from the last four.
constexpr int steps_before = 5;

/// Steps of dt [s]; the vortices start anew before their particles leave empty cells behind.
template <class Make>
void steps(benchmark::State& state, const Make& make, double dt) {
  std::unique_ptr<mpm::Simulation> simulation;
  double t = 0;
  const auto begin = [&] {
    simulation = make();
    for (t = 0; t < (steps_before - 0.5) * dt; t += dt) simulation->advance(t, dt);
  };
  begin();
  const auto particles = static_cast<double>(simulation->particles().size());
  for (auto _ : state) {
    if (t > 0.1 + steps_before * dt) {
      state.PauseTiming();
      begin();
      state.ResumeTiming();
    }
    simulation->advance(t, dt);
    t += dt;
  }
  state.counters["particle-steps"] =
      benchmark::Counter(particles, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["steps"] = benchmark::Counter(1, benchmark::Counter::kIsIterationInvariantRate);
  state.SetLabel(mpm::current_isa());
}

/// Arguments: cells a side, threads.
void vortex(benchmark::State& state, const mpm::Scheme& scheme) {
  const auto cells = static_cast<int>(state.range(0));
  const mpm::Scene scene = vortices(cells);
  steps(
      state, [&] { return mpm::make_simulation(scene, scheme, static_cast<int>(state.range(1))); },
      bench::sonic_step(cells));
}

void general_vortex(benchmark::State& state, const mpm::Scheme& scheme) {
  const auto cells = static_cast<int>(state.range(0));
  const mpm::Scene scene = vortices(cells);
  steps(
      state, [&] { return mpm::make_general_solver(scene, scheme); }, bench::sonic_step(cells));
}

template <class Loop>
void plain_vortex(benchmark::State& state, const mpm::Scheme& scheme) {
  const auto cells = static_cast<int>(state.range(0));
  const auto simulation = mpm::make_simulation(vortices(cells), scheme, 1);
  const auto begin = [&] { return bench::plain_loop<Loop>(cells, simulation->particles()); };
  Loop loop = begin();
  const double dt = bench::sonic_step(cells);
  double t = 0;
  for (auto _ : state) {
    if (t > 0.1) {
      state.PauseTiming();
      loop = begin();
      t = 0;
      state.ResumeTiming();
    }
    loop.step(dt);
    t += dt;
  }
  state.counters["particle-steps"] = benchmark::Counter(static_cast<double>(loop.points().size()),
                                                        benchmark::Counter::kIsIterationInvariantRate);
}

void incompressible_vortex(benchmark::State& state, int degree) {
  const auto cells = static_cast<int>(state.range(0));
  const mpm::Scene scene = vortices(cells);
  mpm::IncompressibleScheme scheme;
  scheme.degree = degree;
  steps(
      state, [&] { return mpm::make_incompressible_solver(scene, scheme, static_cast<int>(state.range(1))); },
      0.25 / cells / bench::speed);
}

void implicit_strip(benchmark::State& state, const mpm::Scheme& scheme) {
  const mpm::Scene scene = strip(static_cast<int>(state.range(0)));
  steps(
      state, [&] { return mpm::make_simulation(scene, scheme, 1); }, 1e-3);
}

const mpm::Scheme full_mass{B::Cubic, T::FullMass, S::Leapfrog}, apic{B::Quadratic, T::Apic, S::Usf},
    sdirk2{B::Cubic, T::FullMass, S::ImplicitSdirk2};

void general_full_mass(benchmark::State& state) {
  general_vortex(state, full_mass);
}
void general_apic(benchmark::State& state) {
  general_vortex(state, apic);
}

void plain_full_mass(benchmark::State& state) {
  plain_vortex<plain::FullMass>(state, full_mass);
}
void plain_apic(benchmark::State& state) {
  plain_vortex<plain::Apic>(state, apic);
}

const std::vector<std::vector<std::int64_t>> sizes{{16, 32, 64, 128, 256}, {1}};

}  // namespace

BENCHMARK_CAPTURE(vortex, cubic_full_mass_leapfrog, full_mass)->ArgsProduct(sizes);
BENCHMARK_CAPTURE(vortex, quadratic_apic, apic)->ArgsProduct(sizes);
BENCHMARK(general_full_mass)->Name("general_vortex/cubic_full_mass_leapfrog")->Arg(64);
BENCHMARK(general_apic)->Name("general_vortex/quadratic_apic")->Arg(64);
BENCHMARK(plain_full_mass)->Name("plain_vortex/cubic_full_mass_leapfrog")->Arg(64);
BENCHMARK(plain_apic)->Name("plain_vortex/quadratic_apic")->Arg(64);
// As step/linear_threads.
BENCHMARK_CAPTURE(vortex, cubic_full_mass_leapfrog_threads, full_mass)
    ->Args({128, 1})
    ->Args({128, 2})
    ->Repetitions(15)
    ->UseRealTime();
BENCHMARK_CAPTURE(vortex, quadratic_apic_threads, apic)
    ->Args({128, 1})
    ->Args({128, 2})
    ->Repetitions(15)
    ->UseRealTime();
BENCHMARK_CAPTURE(implicit_strip, cubic_full_mass_sdirk2, sdirk2)->Arg(40);
BENCHMARK_CAPTURE(incompressible_vortex, k3, 3)->ArgsProduct({{32, 64, 128}, {1}});
