#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "reports/records/directory/bench_file.hpp"
#include "tests/bench/bench_figures.hpp"
#include "tests/bench/collector.hpp"
#include "tests/bench/derived.hpp"
#include "tests/bench/whole_process.hpp"

namespace {

/// mpm-bench OUT [options of Google Benchmark]: rates, what they say together, and whole processes, as
/// OUT/bench.csv and two figures.
int run(int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') {
    fmt::print(stderr, "mpm-bench: the first argument is the directory of the results\n");
    return 2;
  }
  const std::filesystem::path out = argv[1];
  // Repetitions in random order, so that a machine that slows down does so for all; the user's options win.
  std::string defaults[] = {"--benchmark_repetitions=5", "--benchmark_min_time=0.1",
                            "--benchmark_enable_random_interleaving=true"};
  std::vector<char*> arguments{argv[0]};
  for (std::string& option : defaults) arguments.push_back(option.data());
  arguments.insert(arguments.end(), argv + 2, argv + argc);
  int count = static_cast<int>(arguments.size());
  const bool filtered = argc > 2;
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  reports::ensure_directory(out);
  bench::Collector rates;
  benchmark::RunSpecifiedBenchmarks(&rates);
  std::vector<reports::BenchRecord> records = rates.records(), conclusions = bench::derived(rates);
  if (!filtered) {
    const auto whole = bench::whole_processes();
    conclusions.insert(conclusions.end(), whole.begin(), whole.end());
  }
  fmt::print("\n");
  for (const auto& r : conclusions)
    fmt::print("{:<34} {:<56} {:>10.4g} {:<2} +- {:.0f} %\n", r.benchmark, r.quantity, r.value, r.unit,
               100 * r.spread);
  records.insert(records.end(), conclusions.begin(), conclusions.end());
  reports::write_csv(out / "bench.csv", reports::bench_columns, records);
  if (const std::string said = bench::draw_figures(out, rates); !said.empty())
    fmt::print(stderr, "warning: {}\n", said);
  fmt::print("written: {}\n", (out / "bench.csv").string());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "mpm-bench: {}\n", error.what());
    return 3;
  }
}
