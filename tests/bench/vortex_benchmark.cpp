#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "solver/incompressible/make_incompressible_solver.hpp"
#include "solver/kernel/isa.hpp"
#include "solver/simulation.hpp"
#include "solver/step/solver.hpp"

// Rates of a step of the schemes that are accurate in two dimensions: Taylor-Green vortices in a periodic
// box, Re 100, c = 20 U, by the general solver in the same run, which visits particle by particle; and of the
// implicit rule on a strip.

namespace {

using B = mpm::Scheme::Basis;
using T = mpm::Scheme::Transfer;
using S = mpm::Scheme::Stepping;

constexpr double speed = 1, sound = 20 * speed;

mpm::Scene vortices(int cells) {
  mpm::Scene scene;
  scene.size = {1, 1};
  scene.cells = {cells, cells};
  scene.fluid.bulk_modulus = 1000 * sound * sound / 7;
  scene.fluid.rheology = mpm::Newtonian{10};
  scene.initial_velocity = [](const mpm::Vec2& x) {
    constexpr double k = 2 * std::numbers::pi;
    return mpm::Vec2(std::sin(k * x.x()) * std::cos(k * x.y()), -std::cos(k * x.x()) * std::sin(k * x.y()));
  };
  return scene;
}

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

/// Steps of dt [s], but for the first, which factorises or makes room; the vortices start anew before their
/// particles leave empty cells behind.
template <class Make>
void steps(benchmark::State& state, const Make& make, double dt) {
  std::unique_ptr<mpm::Simulation> simulation;
  double t = 0;
  const auto begin = [&] {
    simulation = make();
    simulation->advance(0, dt);
    t = dt;
  };
  begin();
  const auto particles = static_cast<double>(simulation->particles().size());
  for (auto _ : state) {
    if (t > 0.1) {
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

/// A third of a cell of sound.
double sonic(int cells) {
  return 0.3 / cells / sound;
}

/// Arguments: cells a side, threads.
void vortex(benchmark::State& state, const mpm::Scheme& scheme) {
  const auto cells = static_cast<int>(state.range(0));
  const mpm::Scene scene = vortices(cells);
  steps(
      state, [&] { return mpm::make_simulation(scene, scheme, static_cast<int>(state.range(1))); },
      sonic(cells));
}

template <class Basis, class Transfer>
void general_vortex(benchmark::State& state, const mpm::Scheme& scheme) {
  const auto cells = static_cast<int>(state.range(0));
  const mpm::Scene scene = vortices(cells);
  steps(
      state, [&] { return std::make_unique<mpm::Solver<Basis, Transfer>>(scene, scheme, Transfer{}); },
      sonic(cells));
}

void incompressible_vortex(benchmark::State& state, int degree) {
  const auto cells = static_cast<int>(state.range(0));
  const mpm::Scene scene = vortices(cells);
  mpm::IncompressibleScheme scheme;
  scheme.degree = degree;
  steps(
      state, [&] { return mpm::make_incompressible_solver(scene, scheme, static_cast<int>(state.range(1))); },
      0.25 / cells / speed);
}

void implicit_strip(benchmark::State& state, const mpm::Scheme& scheme) {
  const mpm::Scene scene = strip(static_cast<int>(state.range(0)));
  steps(
      state, [&] { return mpm::make_simulation(scene, scheme, 1); }, 1e-3);
}

const mpm::Scheme full_mass{B::Cubic, T::FullMass, S::Leapfrog}, apic{B::Quadratic, T::Apic, S::Usf},
    sdirk2{B::Cubic, T::FullMass, S::ImplicitSdirk2};

void general_full_mass(benchmark::State& state) {
  general_vortex<mpm::CubicBasis, mpm::FullMass>(state, full_mass);
}
void general_apic(benchmark::State& state) {
  general_vortex<mpm::QuadraticBasis, mpm::Apic>(state, apic);
}

const std::vector<std::vector<std::int64_t>> sizes{{16, 32, 64, 128, 256}, {1}};

}  // namespace

BENCHMARK_CAPTURE(vortex, cubic_full_mass_leapfrog, full_mass)->ArgsProduct(sizes);
BENCHMARK_CAPTURE(vortex, quadratic_apic, apic)->ArgsProduct(sizes);
BENCHMARK(general_full_mass)->Name("general_vortex/cubic_full_mass_leapfrog")->Arg(64);
BENCHMARK(general_apic)->Name("general_vortex/quadratic_apic")->Arg(64);
BENCHMARK_CAPTURE(vortex, quadratic_apic_threads, apic)->Args({128, 1})->Args({128, 2})->UseRealTime();
BENCHMARK_CAPTURE(implicit_strip, cubic_full_mass_sdirk2, sdirk2)->Arg(40);
BENCHMARK_CAPTURE(incompressible_vortex, k3, 3)->ArgsProduct({{32, 64, 128}, {1}});
