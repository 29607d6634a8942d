#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>

#define MPM_ISA peak
#include "solver/kernel/storage.hpp"

// What this machine can do at best, measured in the same run as the solver: multiply-adds in registers, and
// bytes streamed through memory that no cache holds, on pages as large as the solver's.

#if defined(__x86_64__) && !defined(__clang__)
#define WIDEST_OF_THIS_MACHINE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define WIDEST_OF_THIS_MACHINE
#endif

namespace {

constexpr std::size_t rounds = 1 << 14;

using Array = mpm::peak::LargeArray<double>;

/// rounds x sums multiply-adds, none waiting for another of the same round. Returns a number that depends on
/// all.
template <std::size_t sums>
[[gnu::always_inline]] inline double multiply_add(double factor, double term) {
  double sum[sums];
  for (double& s : sum) s = term;
  for (std::size_t round = 0; round < rounds; ++round)
#pragma GCC unroll 96
    for (std::size_t i = 0; i < sums; ++i) sum[i] = sum[i] * factor + term;
  double total = 0;
  for (const double s : sum) total += s;
  return total;
}

// Two pipelines of four cycles' latency need eight registers of independent sums, and those of SSE2 and AVX2
// are sixteen: twelve registers each of two, four and eight lanes. Which is right, the machine says.
WIDEST_OF_THIS_MACHINE double sums_24(double factor, double term) {
  return multiply_add<24>(factor, term);
}
WIDEST_OF_THIS_MACHINE double sums_48(double factor, double term) {
  return multiply_add<48>(factor, term);
}
WIDEST_OF_THIS_MACHINE double sums_96(double factor, double term) {
  return multiply_add<96>(factor, term);
}

struct MultiplyAdd {
  double (*run)(double, double);
  std::size_t sums;

  [[nodiscard]] double seconds_a_sum() const {
    double best = 1;
    for (int repetition = 0; repetition < 5; ++repetition) {
      const auto begin = std::chrono::steady_clock::now();
      benchmark::DoNotOptimize(run(0.999, 1e-3));
      best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return best / static_cast<double>(sums);
  }
};

MultiplyAdd fastest_multiply_add() {
  const std::array<MultiplyAdd, 3> all{{{sums_24, 24}, {sums_48, 48}, {sums_96, 96}}};
  return *std::min_element(all.begin(), all.end(), [](const MultiplyAdd& a, const MultiplyAdd& b) {
    return a.seconds_a_sum() < b.seconds_a_sum();
  });
}

/// y += factor x (BLAS axpy): reads both, writes one, and nothing is fetched only to be overwritten, so that
/// the bytes that are counted are the bytes that move.
WIDEST_OF_THIS_MACHINE void axpy(Array& y, const Array& x, double factor) {
  double* to = y.data();
  const double* from = x.data();
  for (std::size_t i = 0; i < y.size(); ++i) to[i] += factor * from[i];
}

void peak_arithmetic(benchmark::State& state) {
  static const MultiplyAdd fastest = fastest_multiply_add();
  double factor = 0.999;
  for (auto _ : state) {
    benchmark::DoNotOptimize(factor);
    benchmark::DoNotOptimize(fastest.run(factor, 1e-3));
  }
  state.counters["operations"] = benchmark::Counter(2.0 * static_cast<double>(fastest.sums * rounds),
                                                    benchmark::Counter::kIsIterationInvariantRate);
}

/// Argument: MiB of both arrays.
void peak_bandwidth(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0)) * (1 << 20) / (2 * sizeof(double));
  Array y(count, 1.0), x(count, 2.0);
  for (auto _ : state) {
    axpy(y, x, 0.5);
    benchmark::ClobberMemory();
  }
  state.counters["bytes"] = benchmark::Counter(3.0 * sizeof(double) * static_cast<double>(count),
                                               benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

BENCHMARK(peak_arithmetic)->Name("peak/arithmetic");
// As much as a million particles and their nodes take, and so much that no shared cache holds it either.
BENCHMARK(peak_bandwidth)->Name("peak/bandwidth")->Arg(72)->Arg(768)->Unit(benchmark::kMillisecond);
