#include "verification/checks/check_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "verification/checks/expected_checks.hpp"
#include "verification/checks/quantities/quantities.hpp"
#include "verification/checks/stability_checks.hpp"

namespace verification {
namespace {

const CheckKind& kind_named(const std::string& name, const TomlTable& table) {
  std::string known;
  for (const CheckKind& kind : check_kinds()) {
    if (kind.name == name) return kind;
    known += (known.empty() ? "" : ", ") + std::string(kind.name);
  }
  table.fail("kind", "'" + name + "' is not known; choose one of: " + known);
}

reports::CheckRecord completion(const StudyData& data) {
  CheckSpec spec;
  spec.lower = spec.upper = 0;
  spec.reason = "no run of this study is expected to diverge; each that does is listed in runs.csv";
  const auto broken = std::ranges::count_if(data.runs, [](const RunData& run) { return !run.completed(); });
  return judge(spec, data, "runs that did not complete", static_cast<double>(broken), "runs");
}

}  // namespace

std::vector<Record> records_of(const CheckSpec& spec) {
  if (!spec.quantity.empty() && is_quantity(spec.quantity)) return {record_of(spec.quantity)};
  if (spec.kind == "conservation" || spec.kind == "crossing") return {Record::History};
  if (spec.kind == "chatter") return {Record::Shear};
  if (spec.kind == "divergence" || is_stability_kind(spec.kind)) return {};
  return {Record::Profile};
}

CheckSpec read_check(TomlTable& table, const Study& study) {
  CheckSpec spec;
  spec.kind = table.text("kind");
  spec.reason = table.text("reason");
  if (spec.reason.find_first_not_of(" \n\t") == std::string::npos)
    table.fail("reason", "must say where the tolerance comes from");
  spec.variants = table.has("variants") ? table.texts("variants") : study.variants;
  for (const std::string& variant : spec.variants)
    if (std::ranges::count(study.variants, variant) == 0)
      table.fail("variants", "'" + variant + "' is no variant of this study");
  spec.lower = table.number("lower", spec.lower);
  spec.upper = table.number("upper", spec.upper);
  if (spec.lower > spec.upper) table.fail("lower", "must not exceed upper");
  spec.claim = table.text("evidence_for", "");
  const CheckKind& kind = kind_named(spec.kind, table);
  if (study.runs.empty() && !is_stability_kind(spec.kind))
    table.fail("kind", "needs runs, and a study with [stability] has none");
  kind.read(table, study, spec);
  table.refuse_unknown_keys();
  return spec;
}

reports::CheckRecord judge(const CheckSpec& spec, const StudyData& data, const std::string& check,
                           double observed, const std::string& unit) {
  const bool holds = spec.lower <= observed && observed <= spec.upper;
  return {data.study->name,        check,      observed, spec.lower, spec.upper, unit,
          holds ? "pass" : "fail", spec.reason};
}

namespace {

using Evidence = std::vector<std::pair<std::string, reports::CheckRecord>>;  // claim, check

/// The claim as it stands after its checks: borne out only if all of them hold.
reports::ClaimRecord judged(const ClaimSpec& claim, const StudyData& data, const Evidence& evidence) {
  reports::ClaimRecord record{claim.id, data.study->name, claim.source, claim.statement, claim.verdict,
                              "",       claim.note,       true};
  for (const auto& [id, check] : evidence) {
    if (id != claim.id) continue;
    record.measured += fmt::format("{}{}: {:.4g}{}", record.measured.empty() ? "" : "; ", check.check,
                                   check.observed, check.unit == "1" ? "" : " " + check.unit);
    record.stands = record.stands && check.verdict == "pass";
  }
  return record;
}

/// Where nothing could be judged because a run failed, the reason says which one and why.
void explain_failures(StudyData& data) {
  const auto failed = std::ranges::find_if(
      data.runs, [](const RunData& run) { return run.record.status.starts_with("failed: "); });
  if (failed == data.runs.end()) return;
  for (reports::CheckRecord& check : data.checks)
    if (check.verdict != "pass" && (std::isnan(check.observed) || check.unit == "runs"))
      check.reason += "; run " + failed->record.run + " " + failed->record.status;
}

/// A check that was to be made and was not is one that failed.
void require_number(StudyData& data, std::size_t made, std::optional<std::size_t> expected,
                    const std::string& what) {
  if (!expected || made == *expected) return;
  CheckSpec spec;
  spec.lower = spec.upper = static_cast<double>(*expected);
  spec.reason = "known before the study ran; what is missing proves nothing";
  data.checks.push_back(judge(spec, data, what, static_cast<double>(made), "checks"));
}

}  // namespace

void evaluate_checks(StudyData& data) {
  Evidence evidence;

  for (const CheckSpec& spec : data.study->checks) {
    const std::size_t before = data.checks.size();
    kind_named(spec.kind, TomlTable::from_text("", data.study->name)).evaluate(spec, data, data.checks);
    require_number(data, data.checks.size() - before, expected_checks(spec, *data.study),
                   "\"" + spec.kind + "\" checks made");
    for (std::size_t i = before; i < data.checks.size(); ++i)
      evidence.emplace_back(spec.claim, data.checks[i]);
  }
  if (!declares_fate(*data.study) && !data.runs.empty()) data.checks.push_back(completion(data));
  explain_failures(data);
  for (const ClaimSpec& claim : data.study->claims) data.claims.push_back(judged(claim, data, evidence));
}

void require_all_checks(StudyData& data) {
  const Study& study = *data.study;
  require_number(data, data.checks.size(),
                 study.declared_checks ? study.declared_checks : expected_checks(study),
                 "checks made in all");
}

}  // namespace verification
