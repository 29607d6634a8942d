#include "tests/bench/collector.hpp"

#include <algorithm>
#include <limits>

namespace bench {

Rate rate_of(std::vector<double> repetitions) {
  std::ranges::sort(repetitions, std::ranges::greater());
  const double fastest = repetitions.front(), median = repetitions[repetitions.size() / 2];
  return {fastest,
          repetitions.size() > 1 ? (fastest - median) / fastest : std::numeric_limits<double>::quiet_NaN()};
}

void Collector::ReportRuns(const std::vector<Run>& runs) {
  std::vector<Run> shown;
  for (const Run& run : runs) {
    if (run.run_type == Run::RT_Aggregate && run.aggregate_name == "median") shown.push_back(run);
    if (run.run_type == Run::RT_Aggregate) continue;
    if (run.repetitions == 1) shown.push_back(run);
    auto name = run.run_name;
    name.repetitions.clear();  // how often something was measured is not what was measured
    for (const auto& [counter, value] : run.counters)
      if (value.flags & benchmark::Counter::kIsRate) counters_[name.str()][counter].push_back(value);
  }
  if (!shown.empty()) ConsoleReporter::ReportRuns(shown);
}

Rate Collector::rate(const std::string& benchmark, const std::string& counter) const {
  return rate_of(counters_.at(benchmark).at(counter));
}

std::vector<reports::BenchRecord> Collector::records() const {
  std::vector<reports::BenchRecord> records;
  for (const auto& [benchmark, counters] : counters_)
    for (const auto& [counter, values] : counters) {
      const Rate rate = rate_of(values);
      records.push_back({benchmark, "rate", rate.value, counter + "/s", rate.spread});
    }
  return records;
}

}  // namespace bench
