#pragma once

#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "verification/runs/run_data.hpp"

namespace verification {

/// Runs a scene, or takes the finished run over. Throws what run_simulation() throws.
using PilotRunner = std::function<RunData(const Study& study, const PlannedRun& plan)>;

/// The runs that steps are chosen by: levels of a ladder at whole parts of the interval that all intervals
/// between outputs are multiples of. Each is made when it is first asked for, and recorded.
class PilotRuns {
 public:
  PilotRuns(const Study& study, const std::vector<const PlannedRun*>& levels, const PilotRunner& run);

  /// The step of so many parts [s].
  [[nodiscard]] double dt_of(long parts) const { return interval_ / static_cast<double>(parts); }
  const RunData& at(std::size_t level, long parts);
  /// Parts of those of a level that completed so far, longest step first.
  [[nodiscard]] std::vector<long> completed(std::size_t level) const;

  /// In the order in which they were made.
  [[nodiscard]] const std::vector<reports::PilotRecord>& records() const { return records_; }
  [[nodiscard]] const std::vector<reports::TimingRecord>& timings() const { return timings_; }

 private:
  struct Trial {
    std::unique_ptr<const PlannedRun> plan;
    RunData data;
  };

  Study study_;  // as one whose time is not measured
  const std::vector<const PlannedRun*>& levels_;
  const PilotRunner& run_;
  double interval_;  // [s]
  std::map<std::pair<std::size_t, long>, Trial> trials_;
  std::vector<reports::PilotRecord> records_;
  std::vector<reports::TimingRecord> timings_;
};

// Relative L2 norms on the grid, the largest of all output times; infinite as soon as one has no value.

/// Of the error against the solution.
double largest_error(const RunData& run);
/// Of the difference of two runs on one mesh.
double difference(const RunData& a, const RunData& b);
/// Of the difference of a run to one on a finer mesh.
double difference_to_finer(const RunData& run, const RunData& finer);

/// The grid's values at dt = 0, from those of a step and of half of it (Richardson). Holds no others.
RunData at_zero_step(const RunData& step, const RunData& half, double order);

}  // namespace verification
