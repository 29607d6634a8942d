#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "verification/checks/chatter_check.hpp"
#include "verification/checks/check_keys.hpp"
#include "verification/checks/check_reader.hpp"
#include "verification/checks/comparison.hpp"
#include "verification/checks/outcome_check.hpp"
#include "verification/checks/shift_check.hpp"
#include "verification/checks/stability_checks.hpp"
#include "verification/convergence/order_remark.hpp"
#include "verification/not_a_number.hpp"
#include "verification/runs/measures.hpp"
#include "verification/runs/scheme_matrix.hpp"

namespace verification {
namespace {

using Records = std::vector<reports::CheckRecord>;
// ---- error: a relative error norm at each time

void read_error(TomlTable& table, const Study& study, CheckSpec& spec) {
  require_upper(table, spec, 0);
  read_locations(table, study, spec);
  read_norm(table, spec);
  read_times(table, study, spec);
  read_level(table, study, spec);
  read_scale(table, spec);
}

void evaluate_error(const CheckSpec& spec, const StudyData& data, Records& records) {
  for (const std::string& variant : spec.variants)
    for (const RunData* run : levels_of(spec, data, variant))
      for (const reports::ErrorRecord& error : run->errors)
        for (const Location location : spec.locations)
          if (error.location == name(location) && std::ranges::count(spec.times, error.t) > 0)
            records.push_back(judge(with_scale(spec, error), data,
                                    fmt::format("{}{} error, {}, t = {} s", label(spec, *run), spec.norm,
                                                error.location, error.t),
                                    relative_error(spec, *run, error), "1"));
}

// ---- order: the observed convergence order in a band

void read_order(TomlTable& table, const Study& study, CheckSpec& spec) {
  if (study.ladder.axis == Axis::None) table.fail("kind", "\"order\" needs a [ladder]");
  require_band(table);
  const std::string judge = table.text("judge", "point");
  if (judge != "point" && judge != "interval") table.fail("judge", "must be \"point\" or \"interval\"");
  spec.whole_interval = judge == "interval";
  read_locations(table, study, spec);
  read_norm(table, spec);
  read_times(table, study, spec);
}

/// The end of an order's interval that lies farther out of the band, or nearer to leaving it.
double worse_end(const CheckSpec& spec, const reports::OrderRecord& order) {
  return spec.lower - order.ci_lower > order.ci_upper - spec.upper ? order.ci_lower : order.ci_upper;
}

std::vector<reports::LevelRecord> levels_behind(const StudyData& data, const reports::OrderRecord& order) {
  std::vector<reports::LevelRecord> levels;
  for (const reports::LevelRecord& level : data.levels)
    if (level.variant == order.variant && level.location == order.location && level.norm == order.norm &&
        level.t == order.t)
      levels.push_back(level);
  return levels;
}

/// A check of an order with what its interval has to say.
CheckSpec with_interval(CheckSpec spec, const reports::OrderRecord& order) {
  const double width = order.ci_upper - order.ci_lower;
  if (spec.whole_interval)
    spec.reason += fmt::format(" (the whole 95 % interval [{:.3g}, {:.3g}] must lie in the band)",
                               order.ci_lower, order.ci_upper);
  else if (!(width <= spec.upper - spec.lower))
    spec.reason += std::isfinite(width)
                       ? fmt::format(
                             " (its point value decides; the 95 % interval [{:.3g}, {:.3g}] is wider than "
                             "the band)",
                             order.ci_lower, order.ci_upper)
                       : " (its point value decides; so few levels have no interval)";
  return spec;
}

void evaluate_order(const CheckSpec& spec, const StudyData& data, Records& records) {
  for (const reports::OrderRecord& order : data.orders)
    for (const Location location : spec.locations)
      if (order.location == name(location) && order.norm == spec.norm &&
          std::ranges::count(spec.variants, order.variant) > 0 &&
          std::ranges::count(spec.times, order.t) > 0) {
        const double value = spec.whole_interval ? worse_end(spec, order) : order.observed;
        const double observed = order.classification == "monotone" ? value : nan;
        CheckSpec remarked = with_interval(spec, order);
        remarked.reason += order_remark(order, levels_behind(data, order));
        records.push_back(judge(remarked, data,
                                fmt::format("{}{} order, {} {}, t = {} s", label(order.variant), order.axis,
                                            order.location, order.norm, order.t),
                                observed, unit_of(order, observed)));
      }
}

// ---- formal-order: each scheme of a [matrix] within `tolerance` of its own theoretical order

void read_formal_order(TomlTable& table, const Study& study, CheckSpec& spec) {
  if (!study.matrix || study.ladder.axis == Axis::None)
    table.fail("kind", "\"formal-order\" needs a [matrix] and a [ladder]");
  spec.tolerance = table.positive("tolerance");
  read_locations(table, study, spec);
  spec.times = {study.runs.front().scene.outputs.back()};
}

void evaluate_formal_order(const CheckSpec& spec, const StudyData& data, Records& records) {
  for (const reports::OrderRecord& order : data.orders)
    for (const Location location : spec.locations) {
      if (order.location != name(location) || order.norm != "l2" || order.t != spec.times[0]) continue;
      if (std::ranges::count(spec.variants, order.variant) == 0) continue;
      const std::string what =
          fmt::format("{}: formal {} order, {}", order.variant, order.axis, order.location);
      CheckSpec band = spec;
      if (std::isnan(order.theoretical)) {
        band.lower = -1 - spec.tolerance;
        band.upper = 0;
        band.reason =
            "lossy by theory: the error grows as dt shrinks, as 1/dt while small, less as it saturates";
        records.push_back(judge(band, data, what, exact_error_slope(data, order).estimate.order, "1"));
        continue;
      }
      band.lower = order.theoretical - spec.tolerance;
      band.upper = order.theoretical + spec.tolerance;
      const bool usable = order.classification == "monotone" || order.theoretical <= 0;
      const double observed = usable ? order.observed : nan;
      records.push_back(judge(band, data, what, observed, unit_of(order, observed)));
    }
}

// ---- growth: on a time ladder whose error is meant to grow as dt shrinks, the (negative) order in a band

void read_growth(TomlTable& table, const Study& study, CheckSpec& spec) {
  if (study.ladder.axis != Axis::Time) table.fail("kind", "\"growth\" needs a [ladder] in time");
  require_band(table);
  if (spec.upper >= 0) table.fail("upper", "must be negative: the error grows as dt shrinks");
  read_locations(table, study, spec);
  read_norm(table, spec);
  read_times(table, study, spec);
}

void evaluate_growth(const CheckSpec& spec, const StudyData& data, Records& records) {
  for (const reports::OrderRecord& order : data.orders)
    for (const Location location : spec.locations)
      if (order.location == name(location) && order.norm == spec.norm &&
          std::ranges::count(spec.variants, order.variant) > 0 && std::ranges::count(spec.times, order.t) > 0)
        records.push_back(judge(spec, data,
                                fmt::format("{}growth as dt shrinks, {} {}, t = {} s", label(order.variant),
                                            order.location, order.norm, order.t),
                                order.classification == "divergent" ? order.observed : nan, "1"));
}

// ---- particle-bias: mean signed particle error in the middle half of the gap, in units of h^2 F/nu

void read_bias(TomlTable& table, const Study& study, CheckSpec& spec) {
  require_band(table);
  read_times(table, study, spec);
  read_level(table, study, spec);
  for (const PlannedRun& run : study.runs)
    if (std::ranges::count(spec.variants, run.variant) > 0 && !std::isfinite(run.scene.flow->bias_unit(1)))
      table.fail("kind", "\"particle-bias\" is for channels (run " + run.run + ")");
}

void evaluate_bias(const CheckSpec& spec, const StudyData& data, Records& records) {
  for (const std::string& variant : spec.variants)
    for (const RunData* run : levels_of(spec, data, variant))
      for (const double t : spec.times)
        records.push_back(judge(spec, data, fmt::format("{}particle bias, t = {} s", label(spec, *run), t),
                                particle_bias(*run, t), "h^2 F/nu"));
}

// ---- difference: every sample equals that of another variant at the same place across the flow

void read_difference(TomlTable& table, const Study& study, CheckSpec& spec) {
  require_upper(table, spec, 0);
  read_locations(table, study, spec);
  read_times(table, study, spec);
  read_level(table, study, spec);
  read_against(table, study, spec);
}

void evaluate_difference(const CheckSpec& spec, const StudyData& data, Records& records) {
  const auto others = levels_of(spec, data, spec.against);
  for (const std::string& variant : spec.variants) {
    const auto runs = levels_of(spec, data, variant);
    for (std::size_t k = 0; k < runs.size(); ++k)
      for (const Location location : spec.locations)
        for (const double t : spec.times)
          records.push_back(judge(spec, data,
                                  fmt::format("{}largest difference from {}, {}, t = {} s",
                                              label(spec, *runs[k]), spec.against, name(location), t),
                                  largest_difference(*runs[k], *others[k], t, location), "1"));
  }
}

// ---- conservation: mass, or momentum against the impulse of body and wall forces

void read_conservation(TomlTable& table, const Study& study, CheckSpec& spec) {
  require_upper(table, spec, 0);
  read_level(table, study, spec);
  spec.quantity = table.text("quantity");
  if (spec.quantity != "mass" && spec.quantity != "momentum")
    table.fail("quantity", "must be \"mass\" or \"momentum\"");
}

void evaluate_conservation(const CheckSpec& spec, const StudyData& data, Records& records) {
  for (const std::string& variant : spec.variants)
    for (const RunData* run : levels_of(spec, data, variant))
      records.push_back(judge(spec, data, fmt::format("{}drift of {}", label(spec, *run), spec.quantity),
                              spec.quantity == "mass" ? mass_drift(*run) : momentum_drift(*run), "1"));
}

// ---- divergence: these runs, and no others, must break down

void read_divergence(TomlTable&, const Study&, CheckSpec& spec) {
  spec.lower = spec.upper = 1;
}

void evaluate_divergence(const CheckSpec& spec, const StudyData& data, Records& records) {
  for (const RunData& run : data.runs) {
    const bool expected = std::ranges::count(spec.variants, run.plan->variant) > 0;
    records.push_back(judge(spec, data,
                            fmt::format("{} {}", run.record.run, expected ? "diverges" : "completes"),
                            run.completed() != expected ? 1 : 0, "truth"));
  }
}

}  // namespace

const std::vector<CheckKind>& check_kinds() {
  static const std::vector<CheckKind> kinds = [] {
    std::vector<CheckKind> list = {
        {"error", read_error, evaluate_error},
        {"order", read_order, evaluate_order},
        {"formal-order", read_formal_order, evaluate_formal_order},
        {"growth", read_growth, evaluate_growth},
        {"particle-bias", read_bias, evaluate_bias},
        {"difference", read_difference, evaluate_difference},
        {"conservation", read_conservation, evaluate_conservation},
        {"divergence", read_divergence, evaluate_divergence},
    };
    add_quantity_kinds(list);
    add_outcome_kind(list);
    add_chatter_kind(list);
    add_shift_kind(list);
    add_stability_kinds(list);
    return list;
  }();
  return kinds;
}

}  // namespace verification
