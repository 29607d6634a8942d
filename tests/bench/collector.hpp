#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

#include "reports/records/directory/bench_file.hpp"

namespace bench {

/// The fastest of the repetitions, and how far their median lies behind it.
struct Rate {
  double value = 0;   ///< per second
  double spread = 0;  ///< (fastest - median)/fastest [-]; NaN for a single repetition
};
Rate rate_of(std::vector<double> repetitions);

/// Prints medians and keeps the rates of every repetition.
class Collector final : public benchmark::ConsoleReporter {
 public:
  Collector() : ConsoleReporter(OO_None) {}
  void ReportRuns(const std::vector<Run>& runs) override;

  /// Rate that a benchmark counts under a name. Throws std::out_of_range for one that did not run.
  [[nodiscard]] Rate rate(const std::string& benchmark, const std::string& counter) const;
  /// Whether a benchmark ran (a filter may have left it out).
  [[nodiscard]] bool has(const std::string& benchmark) const { return counters_.contains(benchmark); }
  /// All rates, in the order of their names.
  [[nodiscard]] std::vector<reports::BenchRecord> records() const;

 private:
  std::map<std::string, std::map<std::string, std::vector<double>>> counters_;
};

}  // namespace bench
