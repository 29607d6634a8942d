#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <vector>

// What this machine can do at best, measured in the same run as the solver: multiply-adds in registers, and
// bytes streamed through memory that no cache holds.

#if defined(__x86_64__) && !defined(__clang__)
#define WIDEST_OF_THIS_MACHINE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define WIDEST_OF_THIS_MACHINE
#endif

namespace {

// Enough independent sums to fill two pipelines of four cycles' latency at eight lanes; registers hold them.
constexpr std::size_t sums = 96, rounds = 1 << 14;

/// rounds x sums multiply-adds, none waiting for another of the same round. Returns a number that depends on
/// all.
WIDEST_OF_THIS_MACHINE double multiply_add(double factor, double term) {
  double sum[sums];
  for (double& s : sum) s = term;
  for (std::size_t round = 0; round < rounds; ++round)
#pragma GCC unroll 96
    for (std::size_t i = 0; i < sums; ++i) sum[i] = sum[i] * factor + term;
  double total = 0;
  for (const double s : sum) total += s;
  return total;
}

/// a = b + factor c (the triad of McCalpin's STREAM, 1995).
WIDEST_OF_THIS_MACHINE void triad(std::vector<double>& a, const std::vector<double>& b,
                                  const std::vector<double>& c, double factor) {
  double* to = a.data();
  const double *from = b.data(), *scaled = c.data();
  for (std::size_t i = 0; i < a.size(); ++i) to[i] = from[i] + factor * scaled[i];
}

void peak_arithmetic(benchmark::State& state) {
  double factor = 0.999;
  for (auto _ : state) {
    benchmark::DoNotOptimize(factor);
    benchmark::DoNotOptimize(multiply_add(factor, 1e-3));
  }
  state.counters["operations"] =
      benchmark::Counter(2.0 * sums * rounds, benchmark::Counter::kIsIterationInvariantRate);
}

void peak_bandwidth(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0)) * (1 << 20) / (3 * sizeof(double));
  std::vector<double> a(count, 0.0), b(count, 1.0), c(count, 2.0);
  for (auto _ : state) {
    triad(a, b, c, 0.5);
    benchmark::ClobberMemory();
  }
  state.counters["bytes"] = benchmark::Counter(3.0 * sizeof(double) * static_cast<double>(count),
                                               benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

BENCHMARK(peak_arithmetic)->Name("peak/arithmetic");
// 768 MiB in three arrays: beyond the caches that one core can count on.
BENCHMARK(peak_bandwidth)->Name("peak/bandwidth")->Arg(768)->Unit(benchmark::kMillisecond);
