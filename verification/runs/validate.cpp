#include "verification/runs/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "verification/not_a_number.hpp"
#include "verification/validation/bias_scatter.hpp"

namespace verification {
namespace {

const RunData& only_run(const StudyData& data, const std::string& variant) {
  return *std::ranges::find_if(data.runs, [&](const RunData& run) { return run.plan->variant == variant; });
}

RunFiles files_of(const RunData& run) {
  return {&run.profile, &run.history, &run.surface};
}

ComparedRuns runs_compared(const StudyData& data, const std::string& variant) {
  const ValidationSpec& spec = *data.study->validation;
  ComparedRuns runs;
  for (const RunData* run : data.runs_of(variant)) {
    runs.levels.push_back(files_of(*run));
    runs.steps.push_back(run->plan->step);
    if (std::isfinite(run->plan->theoretical)) runs.formal_order = run->plan->theoretical;
  }
  const std::vector<std::string> names = input_variants(spec, variant);
  if (spec.samples > 0) {
    for (const std::string& name : names) runs.samples.push_back(files_of(only_run(data, name)));
  } else {
    for (std::size_t i = 0; i + 1 < names.size(); i += 2)
      runs.sensitivities.emplace_back(files_of(only_run(data, names[i])),
                                      files_of(only_run(data, names[i + 1])));
  }
  return runs;
}

std::string place_of(const reports::ValidationRecord& r) {
  std::string text = fmt::format("t = {:.6g}", r.t);
  if (!std::isnan(r.x)) text += fmt::format(", x = {:.6g}", r.x);
  if (!std::isnan(r.y)) text += fmt::format(", y = {:.6g}", r.y);
  return text;
}

reports::CheckRecord gate(const reports::ValidationRecord& r) {
  const bool predicted = r.verdict == reports::prediction_verdict;
  reports::CheckRecord check;
  check.study = r.study;
  check.check =
      fmt::format("{}{}, {}: {}", r.variant.empty() ? "" : r.variant + ": ", r.quantity, place_of(r),
                  predicted ? "uncertainty k u of the prediction" : r.verdict + ", |E|");
  check.observed = predicted                                    ? r.coverage * r.u_val
                   : r.verdict == reports::inconclusive_verdict ? nan
                                                                : std::abs(r.error);
  check.lower = 0;
  check.upper = r.largest;
  check.unit = r.unit;
  check.verdict = r.borne ? "pass" : "fail";
  check.reason = r.reason;
  return check;
}

}  // namespace

void append_comparison(StudyData& data, const std::string& variant, TableComparison comparison) {
  for (reports::ValidationRecord& point : comparison.points) {
    point.study = data.study->name;
    point.variant = variant;
    data.checks.push_back(gate(point));
    data.validation.push_back(std::move(point));
  }
  for (reports::JointValidationRecord& joint : comparison.joint) {
    joint.study = data.study->name;
    joint.variant = variant;
    data.joint_validation.push_back(std::move(joint));
  }
}

void validate(StudyData& data) {
  if (!data.study->validation) return;
  const ValidationSpec& spec = *data.study->validation;
  for (const std::string& variant : data.study->variants) {
    if (!spec.compares(variant)) continue;
    const ComparedRuns runs = runs_compared(data, variant);
    for (const MeasurementTable& table : spec.tables)
      append_comparison(data, variant, compare_table(table, runs, spec.rules, Missing::Record));
  }
}

std::vector<reports::ValidationBiasRecord> validation_bias(
    const std::vector<reports::ValidationRecord>& records) {
  std::vector<std::string> quantities;
  for (const reports::ValidationRecord& r : records)
    if (std::ranges::count(quantities, r.quantity) == 0) quantities.push_back(r.quantity);
  std::vector<reports::ValidationBiasRecord> result;
  for (const std::string& quantity : quantities) {
    std::vector<CasePair> pairs;
    std::set<std::string> studies;
    double relative = 0;
    for (const reports::ValidationRecord& r : records) {
      if (r.quantity != quantity || !(r.measured > 0 && r.simulated > 0)) continue;
      pairs.push_back({r.simulated, r.measured});
      studies.insert(r.study);
      relative += std::pow(r.u_data / r.measured, 2);
    }
    if (pairs.size() < 2) continue;
    const BiasScatter model =
        bias_and_scatter(pairs, std::sqrt(relative / static_cast<double>(pairs.size())));
    result.push_back({quantity, static_cast<long>(studies.size()), static_cast<long>(pairs.size()),
                      model.bias, model.scatter, model.data_uncertainty});
  }
  return result;
}

std::vector<reports::FigureRecord> computed_measured_figures(
    const std::vector<reports::ValidationBiasRecord>& records) {
  std::vector<reports::FigureRecord> figures;
  for (const reports::ValidationBiasRecord& r : records) {
    reports::FigureRecord figure;
    figure.figure = "validation-" + r.quantity;
    figure.kind = "computed-measured";
    figure.component = r.quantity;
    figure.title = fmt::format("Computed against measured: {}", r.quantity);
    figures.push_back(figure);
  }
  return figures;
}

void add_validation_figures(Study& study, const ComparisonRules& rules) {
  for (const auto& [quantity, borne] : rules.bears)
    for (const char* kind : {"validation", "validation-parts"}) {
      reports::FigureRecord figure;
      figure.figure = study.name + "-" + kind + "-" + quantity;
      figure.study = study.name;
      figure.kind = kind;
      figure.component = quantity;
      figure.title = study.title + ": " + quantity;
      study.figures.push_back(figure);
    }
}

}  // namespace verification
