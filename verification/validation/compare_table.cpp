#include "verification/validation/compare_table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "verification/convergence/eca_hoekstra.hpp"
#include "verification/convergence/gci.hpp"
#include "verification/not_a_number.hpp"
#include "verification/validation/area_metric.hpp"
#include "verification/validation/bias_scatter.hpp"
#include "verification/validation/comparison_error.hpp"
#include "verification/validation/latin_hypercube.hpp"

namespace verification {
namespace {

/// A simulated value with what is uncertain in it, in the unit of the table.
struct Simulated {
  double value = nan, u_num = nan;
  std::vector<double> causes;  // effect of one standard deviation of each shared cause among the inputs
  std::string problem;

  [[nodiscard]] double u_input() const {
    double sum = 0;
    for (const double effect : causes) sum += effect * effect;
    return std::sqrt(sum);
  }
};

/// U covers 95 %: two standard deviations. A ladder that does not converge has no U.
double numerical_uncertainty(const std::vector<double>& steps, const std::vector<double>& values,
                             double formal_order) {
  if (values.size() < 3 || !std::ranges::all_of(values, [](double v) { return std::isfinite(v); }))
    return nan;
  if (values.size() >= 4) return 0.5 * eca_hoekstra(steps, values, std::max(1.0, formal_order)).uncertainty;
  if (values[0] == values[1] && values[1] == values[2]) return 0;  // what every grid represents exactly
  return 0.5 * grid_convergence_index(steps, values, formal_order).uncertainty;
}

class TableComparer {
 public:
  TableComparer(const MeasurementTable& table, const ComparedRuns& runs, const ComparisonRules& rules,
                Missing missing)
      : table_(table), runs_(runs), rules_(rules), missing_(missing) {}

  TableComparison compare() {
    std::vector<std::string> quantities;
    for (const Measurement& row : table_.rows) {
      simulated_.push_back(simulate(row));
      result_.points.push_back(point(row, simulated_.back()));
      if (std::ranges::count(quantities, row.quantity) == 0) quantities.push_back(row.quantity);
    }
    for (const std::string& quantity : quantities) result_.joint.push_back(joint(quantity));
    return std::move(result_);
  }

 private:
  [[nodiscard]] double in_run(const RunFiles& run, const Measurement& row) const {
    const ValidatedQuantity& quantity = *find_validated_quantity(row.quantity);
    const double V = table_.scaled ? rules_.velocity : 1, L = table_.scaled ? rules_.length : 1;
    return quantity.of(run, {row.t * L / V, row.x * L, row.y * L}) /
           (std::pow(V, quantity.velocity_power) * std::pow(L, quantity.length_power));
  }

  [[nodiscard]] Simulated simulate(const Measurement& row) const {
    Simulated result;
    try {
      std::vector<double> values;
      for (const RunFiles& level : runs_.levels) values.push_back(in_run(level, row));
      result.value = values.back();
      result.u_num = std::isnan(rules_.stated_u_num)
                         ? numerical_uncertainty(runs_.steps, values, runs_.formal_order)
                         : rules_.stated_u_num * std::abs(result.value);
      result.causes = causes(row);
      if (!std::isnan(rules_.stated_u_input))
        result.causes.push_back(rules_.stated_u_input * std::abs(result.value));
    } catch (const std::invalid_argument& error) {
      if (missing_ == Missing::Refuse) table_.fail(row, error.what());
      result = {};
      result.problem = error.what();
    }
    return result;
  }

  [[nodiscard]] std::vector<double> causes(const Measurement& row) const {
    std::vector<double> effects;
    for (const auto& [minus, plus] : runs_.sensitivities)
      effects.push_back(0.5 * (in_run(plus, row) - in_run(minus, row)));
    if (runs_.samples.empty()) return effects;
    // The samples' deviations from their mean, each over sqrt(n - 1): the sum of their outer products is the
    // sample covariance of all values of the table.
    std::vector<double> values;
    for (const RunFiles& sample : runs_.samples) values.push_back(in_run(sample, row));
    const double mean = moments(values).mean, scale = std::sqrt(static_cast<double>(values.size()) - 1);
    for (const double value : values) effects.push_back((value - mean) / scale);
    return effects;
  }

  [[nodiscard]] reports::ValidationRecord point(const Measurement& row, const Simulated& s) const {
    const BorneError& borne = rules_.bears.at(row.quantity);
    const ComparedValue value{s.value, row.value, s.u_num, s.u_input(),
                              std::hypot(row.uncertainty, row.shared)};
    reports::ValidationRecord record;
    record.quantity = row.quantity;
    record.unit = row.unit;
    record.t = row.t;
    record.x = row.x;
    record.y = row.y;
    record.measured = value.measured;
    record.u_data = value.u_data;
    record.simulated = value.simulated;
    record.error = value.error();
    record.u_num = value.u_num;
    record.u_input = s.problem.empty() ? value.u_input : nan;
    record.coverage = rules_.coverage;
    record.largest = borne.largest;
    record.reason = borne.reason;
    record.note = s.problem.empty() ? row.note : s.problem;
    record.source = table_.source;
    if (table_.file.empty()) {
      record.measured = record.u_data = record.error = record.area_above = record.area_below = nan;
      record.u_val = std::hypot(record.u_num, record.u_input);
      record.verdict = reports::prediction_verdict;
      record.borne = std::isfinite(record.simulated) && rules_.coverage * record.u_val <= borne.largest;
      return record;
    }
    record.u_val = std::hypot(record.u_num, record.u_input, record.u_data);
    const Area area = area_between(Normal{value.simulated, std::hypot(value.u_num, value.u_input)},
                                   Normal{value.measured, value.u_data});
    record.area_above = area.above;
    record.area_below = area.below;
    record.verdict = name(judge(value, rules_.coverage, borne.largest));
    record.borne = bears(value, rules_.coverage, borne.largest);
    return record;
  }

  [[nodiscard]] reports::JointValidationRecord joint(const std::string& quantity) const {
    std::vector<double> errors, own, shared_data;
    std::vector<std::vector<double>> shared;
    std::vector<CasePair> pairs;
    double relative = 0;
    reports::JointValidationRecord record;
    for (std::size_t i = 0; i < table_.rows.size(); ++i) {
      const Measurement& row = table_.rows[i];
      if (row.quantity != quantity) continue;
      const Simulated& s = simulated_[i];
      errors.push_back(s.value - row.value);
      own.push_back(std::hypot(s.u_num, row.uncertainty));
      shared_data.push_back(row.shared);
      shared.resize(std::max(shared.size(), s.causes.size()));
      for (std::size_t c = 0; c < shared.size(); ++c) {
        shared[c].resize(errors.size() - 1, nan);  // a value that another run could not deliver
        shared[c].push_back(c < s.causes.size() ? s.causes[c] : nan);
      }
      pairs.push_back({s.value, row.value});
      relative += std::pow(std::hypot(row.uncertainty, row.shared) / row.value, 2);
      record.unit = row.unit;
    }
    record.quantity = quantity;
    record.points = static_cast<long>(errors.size());
    record.source = table_.source;
    record.obtained = table_.obtained;
    record.licence = table_.licence;
    record.distance_squared = record.p_value = record.bias = record.scatter = record.data_scatter = nan;
    if (table_.file.empty()) return record;
    shared.push_back(shared_data);
    const JointComparison together = compare_jointly(errors, own, shared);
    record.distance_squared = together.distance_squared;
    record.p_value = together.p_value;
    const double sigma_e = std::sqrt(relative / static_cast<double>(errors.size()));
    const BiasScatter model = bias_and_scatter(pairs, std::isfinite(sigma_e) ? sigma_e : 0);
    record.bias = model.bias;
    record.scatter = model.scatter;
    record.data_scatter = model.data_uncertainty;
    return record;
  }

  const MeasurementTable& table_;
  const ComparedRuns& runs_;
  const ComparisonRules& rules_;
  Missing missing_;
  std::vector<Simulated> simulated_;
  TableComparison result_;
};

}  // namespace

TableComparison compare_table(const MeasurementTable& table, const ComparedRuns& runs,
                              const ComparisonRules& rules, Missing missing) {
  return TableComparer(table, runs, rules, missing).compare();
}

}  // namespace verification
