#include "verification/runs/scores.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "verification/not_a_number.hpp"
#include "verification/runs/measures.hpp"

namespace verification {
namespace {

double final_error(const RunData& run, const std::string& location) {
  const double end = run.plan->scene.outputs.back();
  for (const reports::ErrorRecord& error : run.errors)
    if (error.t == end && error.location == location) return error.l2;
  return nan;
}

/// Time of breakdown in the status that run_simulation() writes.
double time_of_breakdown(const std::string& status) {
  double t = nan;
  return std::sscanf(status.c_str(), "diverged at t = %lf", &t) == 1 ? t : nan;
}

double rms_velocity(const reports::HistoryRow& row) {
  return std::sqrt(2 * row.kinetic_energy / row.mass);
}

/// Without a band nothing is asked of the energy, as of a fluid at rest, which has no ratio.
bool energy_in_band(const reports::ScoreRecord& score) {
  if (score.energy_lower == 0 && std::isinf(score.energy_upper)) return true;
  return score.energy_ratio >= score.energy_lower && score.energy_ratio <= score.energy_upper;
}

}  // namespace

std::string name(Fate fate) {
  switch (fate) {
    case Fate::Survived:
      return "survived";
    case Fate::Degraded:
      return "degraded";
    default:
      return "diverged";
  }
}

double energy_ratio(const RunData& run, double t) {
  double computed = 0, exact = 0;
  for (const reports::ProfileRow* row : rows_at(run, t, Location::Particles)) {
    computed += row->u * row->u + row->v * row->v;
    exact += row->u_exact * row->u_exact + row->v_exact * row->v_exact;
  }
  return exact > 0 ? computed / exact : nan;
}

double time_of_divergence(const RunData& run) {
  double scale = run.plan->scene.flow->velocity_scale();
  if (!run.history.empty()) scale = std::max(scale, rms_velocity(run.history.front()));
  for (const reports::HistoryRow& row : run.history)
    if (!(rms_velocity(row) <= Scoreboard::blown_up * scale)) return row.t;
  return time_of_breakdown(run.record.status);
}

reports::ScoreRecord score_of(const RunData& run, const Study& study) {
  const Scoreboard& board = *study.scoreboard;
  const Expectation& expected = board.expected.at(run.plan->variant);
  const double end = run.plan->scene.outputs.back();
  reports::ScoreRecord record;
  record.study = study.name;
  record.hard_case = board.hard_case;
  record.scheme = run.plan->variant;
  record.basis = run.record.basis;
  record.transfer = run.record.transfer;
  record.stepping = run.record.stepping;
  record.expected = name(expected.fate);
  record.reason = expected.reason;
  record.location = board.location;
  record.degraded_above = board.degraded_above;
  record.energy_lower = board.energy_lower;
  record.energy_upper = board.energy_upper;
  record.thresholds = board.reason;
  record.status = run.record.status;
  record.error = record.energy_ratio = record.t_diverged = nan;
  if (run.record.status.starts_with("failed")) {
    record.outcome = "failed";
    record.verdict = "fail";
    return record;
  }
  record.error = final_error(run, board.location);
  record.energy_ratio = energy_ratio(run, end);
  const double t_diverged = time_of_divergence(run);
  Fate fate = Fate::Survived;
  if (!run.completed() || !std::isnan(t_diverged) || !(record.error <= Scoreboard::blown_up)) {
    fate = Fate::Diverged;
    record.t_diverged = (std::isnan(t_diverged) ? end : t_diverged) - run.plan->scene.start;
  } else if (record.error > board.degraded_above || !energy_in_band(record)) {
    fate = Fate::Degraded;
  }
  record.outcome = name(fate);
  record.verdict = fate == expected.fate ? "pass" : "fail";
  return record;
}

std::vector<reports::ScoreRecord> score_records(const StudyData& data) {
  std::vector<reports::ScoreRecord> records;
  if (!data.study->scoreboard) return records;
  for (const RunData& run : data.runs) records.push_back(score_of(run, *data.study));
  return records;
}

}  // namespace verification
