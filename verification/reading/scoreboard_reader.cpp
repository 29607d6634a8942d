#include "verification/reading/scoreboard_reader.hpp"

#include <algorithm>

#include "verification/runs/scheme_matrix.hpp"
#include "verification/scene/matrix.hpp"

namespace verification {
namespace {

Fate fate_named(const TomlTable& table, const std::string& key, const std::string& text) {
  for (const Fate fate : {Fate::Survived, Fate::Degraded, Fate::Diverged})
    if (name(fate) == text) return fate;
  table.fail(key, "must be \"survived\", \"degraded\" or \"diverged\"");
}

std::string reason_of(TomlTable& table) {
  const std::string reason = table.text("reason");
  if (reason.find_first_not_of(" \n\t") == std::string::npos) table.fail("reason", "must say why");
  return reason;
}

std::vector<std::string> variants_of(TomlTable& table, const std::string& key, const Study& study) {
  if (!table.has(key)) return {};
  const std::vector<std::string> variants = table.texts(key);
  for (const std::string& variant : variants)
    if (std::ranges::count(study.variants, variant) == 0)
      table.fail(key, "'" + variant +
                          "' is no scheme of this study; a scheme of the matrix is written "
                          "basis_transfer_stepping, another one by its [[variant]] name");
  return variants;
}

/// A pattern: lists of parts of the material point method (an absent list takes every one), or schemes by
/// name. One of another method is expected something of by its name alone.
class Pattern {
 public:
  Pattern(TomlTable& table, const Study& study)
      : bases_(part_names(table, "basis", mpm::basis_parts())),
        transfers_(part_names(table, "transfer", mpm::transfer_parts())),
        steppings_(part_names(table, "stepping", mpm::stepping_parts())),
        variants_(variants_of(table, "variants", study)) {}

  [[nodiscard]] bool matches(const PlannedRun& run) const {
    const mpm::Scheme& scheme = run.scene.scheme;
    if ((run.scene.sph || run.scene.incompressible) && variants_.empty()) return false;
    const auto has = [](const std::vector<std::string>& names, const std::string& wanted) {
      return std::ranges::count(names, wanted) > 0;
    };
    return has(bases_, mpm::name(scheme.basis)) && has(transfers_, mpm::name(scheme.transfer)) &&
           has(steppings_, mpm::name(scheme.stepping)) && (variants_.empty() || has(variants_, run.variant));
  }

 private:
  std::vector<std::string> bases_, transfers_, steppings_, variants_;
};

/// Later expectations override earlier ones.
void read_expectations(TomlTable& root, const Study& study, Scoreboard& scoreboard) {
  for (TomlTable& table : root.tables("expect")) {
    const Pattern pattern(table, study);
    const Expectation expectation{fate_named(table, "outcome", table.text("outcome")), reason_of(table)};
    table.refuse_unknown_keys();
    bool any = false;
    for (const PlannedRun& run : study.runs) {
      if (!pattern.matches(run)) continue;
      scoreboard.expected[run.variant] = expectation;
      any = true;
    }
    if (!any) table.fail("outcome", "is expected of no scheme of this study; widen the pattern or remove it");
  }
  for (const std::string& variant : study.variants)
    if (!scoreboard.expected.contains(variant))
      root.fail("expect", "says nothing of scheme '" + variant +
                              "'; add an [[expect]] whose basis, transfer and stepping take it in");
}

}  // namespace

void read_scoreboard(TomlTable& root, Study& study) {
  if (!root.has("scoreboard")) {
    if (root.has("expect")) root.fail("expect", "belongs to a [scoreboard]; add one, or use [[check]]");
    return;
  }
  if (study.ladder.axis != Axis::None) root.fail("scoreboard", "takes one run a scheme; remove the [ladder]");
  TomlTable table = root.table("scoreboard");
  Scoreboard scoreboard;
  scoreboard.hard_case = table.text("case");
  scoreboard.location = table.text("location", "grid");
  if (scoreboard.location != "grid" && scoreboard.location != "particles")
    table.fail("location", "must be \"grid\" or \"particles\"");
  scoreboard.degraded_above = table.positive("degraded_above");
  if (scoreboard.degraded_above >= Scoreboard::blown_up)
    table.fail("degraded_above", "must lie below 10, where a run counts as diverged");
  if (table.has("energy_ratio")) {
    const std::vector<double> band = table.numbers("energy_ratio");
    if (band.size() != 2 || !(0 <= band[0] && band[0] < 1 && 1 < band[1]))
      table.fail("energy_ratio", "must be a band [lower, upper] with 1 inside");
    scoreboard.energy_lower = band[0];
    scoreboard.energy_upper = band[1];
  }
  scoreboard.reason = reason_of(table);
  scoreboard.in_full = variants_of(table, "in_full", study);
  scoreboard.in_quick = variants_of(table, "in_quick", study);
  table.refuse_unknown_keys();
  for (const PlannedRun& run : study.runs)
    if (!run.scene.flow->has_exact())
      root.fail("scoreboard", "needs a flow with an exact solution (run " + run.run + ")");
  read_expectations(root, study, scoreboard);

  CheckSpec outcome;
  outcome.kind = "outcome";
  outcome.variants = study.variants;
  outcome.reason = scoreboard.reason;
  study.checks.push_back(outcome);
  study.scoreboard = std::move(scoreboard);
}

bool restrict_to(Study& study, Suite suite) {
  if (holds(suite, study.suite)) return true;
  if (!study.scoreboard || suite == Suite::Peers) return false;
  // Suites nest: what runs in quick runs in full.
  std::vector<std::string> kept = study.scoreboard->in_quick;
  if (suite == Suite::Full)
    kept.insert(kept.end(), study.scoreboard->in_full.begin(), study.scoreboard->in_full.end());
  const auto dropped = [&](const std::string& variant) { return std::ranges::count(kept, variant) == 0; };
  study.declared_checks.reset();  // they are those of the whole study
  std::erase_if(study.variants, dropped);
  std::erase_if(study.runs, [&](const PlannedRun& run) { return dropped(run.variant); });
  for (CheckSpec& check : study.checks) std::erase_if(check.variants, dropped);
  std::erase_if(study.checks, [&](const CheckSpec& check) {
    return check.variants.empty() || (!check.against.empty() && dropped(check.against));
  });
  return !study.runs.empty();
}

}  // namespace verification
