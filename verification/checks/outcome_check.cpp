#include "verification/checks/outcome_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "verification/runs/scores.hpp"

namespace verification {
namespace {

/// Number of an outcome as checks show it; NaN, which never passes, for a run that was not simulated.
double number_of(const std::string& outcome) {
  for (const Fate fate : {Fate::Survived, Fate::Degraded, Fate::Diverged})
    if (name(fate) == outcome) return static_cast<double>(fate);
  return std::numeric_limits<double>::quiet_NaN();
}

std::string observed(const reports::ScoreRecord& score) {
  if (score.outcome == "failed") return score.status;
  if (score.outcome == "diverged") return fmt::format("diverged {:.4g} s after the start", score.t_diverged);
  return fmt::format("{} with error {:.3g}, energy ratio {:.4g}", score.outcome, score.error,
                     score.energy_ratio);
}

void read_outcome(TomlTable& table, const Study&, CheckSpec&) {
  table.fail("kind",
             "\"outcome\" comes with a [scoreboard] and its [[expect]] entries; remove this [[check]]");
}

void evaluate_outcome(const CheckSpec& spec, const StudyData& data,
                      std::vector<reports::CheckRecord>& records) {
  for (const reports::ScoreRecord& score : score_records(data)) {
    CheckSpec expected = spec;
    expected.lower = expected.upper = number_of(score.expected);
    expected.reason = score.reason;
    if (score.verdict != "pass") expected.reason += "; but it " + observed(score);
    records.push_back(judge(expected, data, score.scheme + ": " + score.expected, number_of(score.outcome),
                            reports::outcome_unit));
  }
}

}  // namespace

void add_outcome_kind(std::vector<CheckKind>& kinds) {
  kinds.push_back({"outcome", read_outcome, evaluate_outcome});
}

}  // namespace verification
