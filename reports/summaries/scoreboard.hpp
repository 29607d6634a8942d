#pragma once

#include <string>
#include <vector>

#include "reports/records/records.hpp"

namespace reports {

/// The outcome is the expected one: its verdict says so and its words agree. A word alone is not believed.
bool as_expected(const ScoreRecord& score);

/// Outcomes of one hard case, counted.
struct CaseSummary {
  std::string study, hard_case;
  std::size_t schemes = 0, survived = 0, degraded = 0, diverged = 0, unexpected = 0;
};
/// One for each hard case, in the order in which they first occur.
std::vector<CaseSummary> summarise(const std::vector<ScoreRecord>& scores);

/// Whether a run's divergence is what the scoreboard expects of it, and so no failure.
bool expected_to_diverge(const Results& results, const RunRecord& run);

/// The checks with the outcomes that hold put together, one line a hard case: for a terminal.
std::vector<CheckRecord> without_expected_outcomes(const Results& results);

/// The scoreboard for Markdown, a row a hard case; "" without records.
std::string markdown_scoreboard(const std::vector<ScoreRecord>& scores);

}  // namespace reports
