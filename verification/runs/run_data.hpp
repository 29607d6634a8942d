#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/records/records.hpp"
#include "reports/records/surface.hpp"
#include "solver/linear_algebra.hpp"
#include "verification/convergence/order.hpp"
#include "verification/study/study.hpp"

namespace verification {

/// What one run left behind.
struct RunData {
  const PlannedRun* plan = nullptr;
  bool foreign = false;  ///< somebody else's solver made it
  reports::RunRecord record;
  reports::TimingRecord timing;
  std::vector<reports::ProfileRow> profile;
  std::vector<reports::HistoryRow> history;
  std::vector<reports::ShearRow> shear;      ///< channels only
  std::vector<reports::StateRow> state;      ///< flows with an exact density only
  std::vector<reports::SurfaceRow> surface;  ///< of a fluid with a free surface only
  mpm::VectorField start;     ///< where the particles were seeded, in the order of the profiles [m]
  std::vector<double> probe;  ///< streamwise grid velocity at the probe at each output reached [m/s]
  std::vector<reports::ErrorRecord> errors;

  [[nodiscard]] bool completed() const { return record.status == "completed"; }
};

/// The row of runs.csv for a planned run that took `steps` and ended with `status`.
reports::RunRecord describe_run(const Study& study, const PlannedRun& plan, long steps,
                                const std::string& status);

/// A run that could not be simulated at all: recorded, so that the tables say so.
RunData failed_run(const Study& study, const PlannedRun& plan, const std::string& why);

/// What a study's runs amount to.
struct StudyData {
  const Study* study = nullptr;
  std::shared_ptr<const Study> settled;  ///< *study, where its runs had a say in it (settle_locations)
  std::vector<RunData> runs;             ///< in the order of study->runs
  std::vector<reports::LevelRecord> levels;
  std::vector<reports::OrderRecord> orders;
  std::vector<reports::CheckRecord> checks;
  std::vector<reports::ClaimRecord> claims;
  std::vector<reports::MatrixRecord> matrix;
  std::vector<reports::ScoreRecord> scores;
  std::vector<reports::ValidationRecord> validation;
  std::vector<reports::JointValidationRecord> joint_validation;
  std::vector<reports::StabilityRecord> stability;       ///< in the order of study->stability.cases
  std::vector<reports::TimingRecord> stability_timings;  ///< one a case
  std::vector<reports::ControlRecord> controls;          ///< one, of a negative control

  [[nodiscard]] std::vector<const RunData*> runs_of(const std::string& variant) const {
    std::vector<const RunData*> found;
    for (const RunData& run : runs)
      if (run.plan->variant == variant) found.push_back(&run);
    return found;
  }
};

}  // namespace verification
