#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#define MPM_ISA peak
#include "solver/kernel/cells/storage.hpp"

// What this machine can do at best, measured in the same run as the solver: multiply-adds in registers, and
// bytes streamed through memory that no cache holds, on pages as large as the solver's.

namespace {

constexpr std::size_t rounds = 1 << 14;

using Array = mpm::peak::LargeArray<double>;

struct TwoLanes {
  using Vector = double __attribute__((vector_size(16)));
};
struct FourLanes {
  using Vector = double __attribute__((vector_size(32)));
};
struct EightLanes {
  using Vector = double __attribute__((vector_size(64)));
};

/// rounds x registers x lanes multiply-adds, none waiting for another of the same round. Two pipelines of
/// four cycles' latency need eight registers of independent sums, and those of SSE2 and AVX2 are sixteen.
/// Returns a number that depends on all.
constexpr std::size_t registers = 12;
template <class Lanes>
[[gnu::always_inline]] inline double multiply_add(double factor, double term) {
  using Vector = typename Lanes::Vector;
  const Vector factors = factor - Vector{}, terms = term - Vector{};
  Vector sum[registers];
  for (Vector& s : sum) s = terms;
  for (std::size_t round = 0; round < rounds; ++round)
    for (Vector& s : sum) s = s * factors + terms;
  double total = 0;
  for (const Vector& s : sum)
    for (std::size_t lane = 0; lane < sizeof s / sizeof(double); ++lane) total += s[lane];
  return total;
}

double with_2_lanes(double factor, double term) {
  return multiply_add<TwoLanes>(factor, term);
}
#ifdef __x86_64__
[[gnu::target("avx2,fma")]] double with_4_lanes(double factor, double term) {
  return multiply_add<FourLanes>(factor, term);
}
[[gnu::target("avx512f")]] double with_8_lanes(double factor, double term) {
  return multiply_add<EightLanes>(factor, term);
}
#endif

struct MultiplyAdd {
  double (*run)(double, double);
  std::size_t lanes;

  [[nodiscard]] double seconds_a_lane() const {
    double best = 1;
    for (int repetition = 0; repetition < 5; ++repetition) {
      const auto begin = std::chrono::steady_clock::now();
      benchmark::DoNotOptimize(run(0.999, 1e-3));
      best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return best / static_cast<double>(lanes);
  }
};

/// Wider registers are not always faster: the machine says.
MultiplyAdd fastest_multiply_add() {
  std::vector<MultiplyAdd> all{{with_2_lanes, 2}};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) all.push_back({with_4_lanes, 4});
  if (__builtin_cpu_supports("avx512f")) all.push_back({with_8_lanes, 8});
#endif
  return *std::min_element(all.begin(), all.end(), [](const MultiplyAdd& a, const MultiplyAdd& b) {
    return a.seconds_a_lane() < b.seconds_a_lane();
  });
}

/// y += factor x (BLAS axpy): reads both, writes one, and nothing is fetched only to be overwritten, so that
/// the bytes that are counted are the bytes that move.
void axpy(Array& y, const Array& x, double factor) {
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
  state.counters["operations"] =
      benchmark::Counter(2.0 * static_cast<double>(fastest.lanes * registers * rounds),
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
