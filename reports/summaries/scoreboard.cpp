#include "reports/summaries/scoreboard.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/pages/report_markdown.hpp"
#include "reports/records/report_data.hpp"

namespace reports {

bool as_expected(const ScoreRecord& score) {
  return score.verdict == "pass" && score.outcome == score.expected;
}

std::vector<CaseSummary> summarise(const std::vector<ScoreRecord>& scores) {
  std::vector<CaseSummary> cases;
  for (const ScoreRecord& score : scores) {
    auto found = std::find_if(cases.begin(), cases.end(),
                              [&](const CaseSummary& c) { return c.study == score.study; });
    if (found == cases.end()) {
      CaseSummary fresh;
      fresh.study = score.study;
      fresh.hard_case = score.hard_case;
      found = cases.insert(cases.end(), fresh);
    }
    ++found->schemes;
    found->survived += score.outcome == "survived";
    found->degraded += score.outcome == "degraded";
    found->diverged += score.outcome == "diverged";
    found->unexpected += !as_expected(score);
  }
  return cases;
}

bool expected_to_diverge(const Results& results, const RunRecord& run) {
  return std::any_of(results.scores.begin(), results.scores.end(), [&](const ScoreRecord& score) {
    return score.study == run.study && run.run == score.study + "." + score.scheme &&
           score.outcome == "diverged" && as_expected(score);
  });
}

std::vector<CheckRecord> without_expected_outcomes(const Results& results) {
  std::vector<CheckRecord> checks;
  for (const CheckRecord& check : results.checks)
    if (check.unit != outcome_unit || !holds(check)) checks.push_back(check);
  for (const CaseSummary& c : summarise(results.scores)) {
    const auto held = std::count_if(results.checks.begin(), results.checks.end(), [&](const CheckRecord& k) {
      return k.study == c.study && k.unit == outcome_unit && holds(k);
    });
    if (held == 0) continue;
    CheckRecord line;
    line.study = c.study;
    line.check = fmt::format("{}: schemes with the expected outcome", c.hard_case);
    line.observed = line.lower = line.upper = static_cast<double>(held);
    line.unit = "schemes";
    line.verdict = "pass";
    checks.push_back(line);
  }
  return checks;
}

std::string markdown_scoreboard(const std::vector<ScoreRecord>& scores) {
  if (scores.empty()) return "";
  std::string text =
      "\n## Stability scoreboard\n\nEvery scheme on every hard case; scheme by scheme with errors, energy "
      "ratios and times of divergence in report.html and scoreboard.csv. Unexpected outcomes stand under "
      "Failures.\n\n| hard case | schemes | survived | degraded | diverged | unexpected |\n"
      "|---|---|---|---|---|---|\n";
  for (const CaseSummary& c : summarise(scores))
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {} |\n", markdown_text(c.hard_case), c.schemes, c.survived,
                    c.degraded, c.diverged, c.unexpected == 0 ? "0" : fmt::format("**{}**", c.unexpected));
  return text;
}

}  // namespace reports
