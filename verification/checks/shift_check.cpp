#include "verification/checks/shift_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "verification/checks/check_keys.hpp"
#include "verification/not_a_number.hpp"

namespace verification {
namespace {

/// The first table of a study that measures a quantity.
const MeasurementTable* table_with(const Study& study, const std::string& quantity) {
  if (study.validation)
    for (const MeasurementTable& table : study.validation->tables)
      if (!table.file.empty() &&
          std::ranges::any_of(table.rows, [&](const Measurement& row) { return row.quantity == quantity; }))
        return &table;
  return nullptr;
}

void read_shift(TomlTable& table, const Study& study, CheckSpec& spec) {
  require_band(table);
  spec.quantity = table.text("quantity");
  const ValidatedQuantity* quantity = find_validated_quantity(spec.quantity);
  if (!quantity || !quantity->between_outputs || !table_with(study, spec.quantity))
    table.fail("quantity", "must be front or column-height, and measured in a table of [validation]");
  spec.tolerance = table.positive("largest_deviation");
  read_level(table, study, spec);
}

/// The table's rows of a quantity in SI units.
std::vector<Measurement> rows_in_si(const MeasurementTable& table, const ComparisonRules& rules,
                                    const ValidatedQuantity& quantity) {
  const double V = table.scaled ? rules.velocity : 1, L = table.scaled ? rules.length : 1;
  const double unit = std::pow(V, quantity.velocity_power) * std::pow(L, quantity.length_power);
  std::vector<Measurement> rows;
  for (Measurement row : table.rows) {
    if (row.quantity != quantity.name) continue;
    row.t *= L / V;
    row.value *= unit;
    row.uncertainty *= unit;
    rows.push_back(row);
  }
  return rows;
}

void evaluate_shift(const CheckSpec& spec, const StudyData& data,
                    std::vector<reports::CheckRecord>& records) {
  const MeasurementTable& table = *table_with(*data.study, spec.quantity);
  const ComparisonRules& rules = data.study->validation->rules;
  const ValidatedQuantity& quantity = *find_validated_quantity(spec.quantity);
  const double V = table.scaled ? rules.velocity : 1, L = table.scaled ? rules.length : 1;
  const double unit = std::pow(V, quantity.velocity_power) * std::pow(L, quantity.length_power);
  CheckSpec remaining = spec;
  remaining.lower = 0;
  remaining.upper = spec.tolerance;
  for (const std::string& variant : spec.variants)
    for (const RunData* run : levels_of(spec, data, variant)) {
      BestShift best{nan, nan};
      try {
        if (run->completed())
          best =
              best_shift({&run->profile, &run->history, &run->surface}, rows_in_si(table, rules, quantity));
      } catch (const std::invalid_argument&) {  // it delivers no such thing: NaN, which fails
      }
      const std::string of = label(spec, *run) + spec.quantity;
      records.push_back(judge(spec, data, of + ": measured time minus simulated, best shift",
                              best.shift * V / L, table.scaled ? "1" : "s"));
      records.push_back(judge(remaining, data, of + ": root mean square of what remains after it",
                              best.deviation / unit, table.scaled ? "1" : quantity.unit));
    }
}

}  // namespace

BestShift best_shift(const RunFiles& run, const std::vector<Measurement>& rows) {
  if (rows.empty() || !run.surface || run.surface->size() < 2)
    throw std::invalid_argument("a best shift needs measurements and a record of a free surface");
  const ValidatedQuantity& quantity = *find_validated_quantity(rows.front().quantity);
  double first = rows.front().t, last = first, weights = 0;
  for (const Measurement& row : rows) {
    first = std::min(first, row.t);
    last = std::max(last, row.t);
    weights += 1 / (row.uncertainty * row.uncertainty);
  }
  const double least = last - run.surface->back().t, most = first - run.surface->front().t;
  if (!(most > least)) throw std::invalid_argument("the run is too short for its measurements; run it on");
  const auto mean_square = [&](double shift) {
    double sum = 0;
    for (const Measurement& row : rows) {
      const double t =
          std::clamp(row.t - shift, run.surface->front().t, run.surface->back().t);  // round-off at the ends
      sum += std::pow((quantity.of(run, {t, nan, nan}) - row.value) / row.uncertainty, 2);
    }
    return sum / weights;
  };
  // The sum of squares of a record that only grows, or only falls, has one minimum; a coarse search first
  // finds it for others, too.
  constexpr int trials = 200;
  double best = least, step = (most - least) / trials;
  for (int k = 1; k <= trials; ++k)
    if (mean_square(least + k * step) < mean_square(best)) best = least + k * step;
  for (; step > 1e-9 * (most - least); step /= 2)
    for (const double side : {-step, step}) {
      const double there = std::clamp(best + side, least, most);
      if (mean_square(there) < mean_square(best)) best = there;
    }
  return {best, std::sqrt(mean_square(best))};
}

void add_shift_kind(std::vector<CheckKind>& kinds) {
  kinds.push_back({"shift", read_shift, evaluate_shift});
}

}  // namespace verification
