#include "verification/checks/chatter_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "verification/checks/check_keys.hpp"

namespace verification {
namespace {

// Of the critical shear rate, which is what chatter grows to: linear growth ends where the mean of the
// viscosity falls to the stable one.
constexpr double noticeable = 0.25;

/// The index of a power law from its flow curve.
double power_law_index(const FluidConfig& fluid) {
  return 1 + std::log2(fluid.viscosity_ratio(2) / fluid.viscosity_ratio(1));
}

double critical_shear_rate(const CheckSpec& spec, const SceneConfig& scene) {
  return verification::critical_shear_rate(spec.stability_limit, scene.cell_size(), scene.segments.front().dt,
                                           scene.fluid.kinematic_viscosity, power_law_index(scene.fluid));
}

void read_chatter(TomlTable& table, const Study& study, CheckSpec& spec) {
  require_band(table);
  read_level(table, study, spec);
  read_against(table, study, spec);
  read_times(table, study, spec);
  spec.stability_limit = table.positive("stability_limit");
  for (const PlannedRun& run : study.runs) {
    if (std::ranges::count(spec.variants, run.variant) == 0 && run.variant != spec.against) continue;
    if (!run.scene.fluid.label.starts_with("power-law") || power_law_index(run.scene.fluid) >= 1)
      table.fail("kind", "\"chatter\" is for power laws with an index below 1 (run " + run.run + ")");
    for (const double t : spec.times)
      if (std::ranges::count(run.scene.outputs, t) == 0)
        table.fail("times", fmt::format("{} is no output time of run {}", t, run.run));
  }
}

/// Largest shear rate that chatters at any of the times: what chatters at one instant is up to chance.
double widest_band(const CheckSpec& spec, const RunData& run, const RunData& calm, double amplitude) {
  if (!run.completed() || !calm.completed()) return std::numeric_limits<double>::quiet_NaN();
  double widest = 0;
  for (const double t : spec.times) {
    const double band = chattering_shear_rate(run, calm, t, amplitude);
    if (!(band <= widest)) widest = band;  // keeps a NaN
  }
  return widest;
}

void evaluate_chatter(const CheckSpec& spec, const StudyData& data,
                      std::vector<reports::CheckRecord>& records) {
  const RunData& calm = *levels_of(spec, data, spec.against).back();
  for (const std::string& variant : spec.variants)
    for (const RunData* run : levels_of(spec, data, variant)) {
      const double critical = critical_shear_rate(spec, run->plan->scene);
      const double band = widest_band(spec, *run, calm, noticeable * critical);
      records.push_back(judge(spec, data, label(spec, *run) + "largest shear rate that chatters",
                              band / critical, fmt::format("gdot_crit = {:.3g}/s", critical)));
    }
}

}  // namespace

double critical_shear_rate(double limit, double h, double dt, double nu, double index) {
  return std::pow(limit * h * h / (index * nu * dt), 1 / (index - 1));
}

double chattering_shear_rate(const RunData& run, const RunData& calm, double t, double amplitude) {
  std::vector<const reports::ShearRow*> rows, calm_rows;
  for (const reports::ShearRow& row : run.shear)
    if (row.t == t && row.location == "cells") rows.push_back(&row);
  for (const reports::ShearRow& row : calm.shear)
    if (row.t == t && row.location == "cells") calm_rows.push_back(&row);
  if (rows.empty() || rows.size() != calm_rows.size()) return std::numeric_limits<double>::quiet_NaN();
  const auto excess = [&](std::size_t j) { return rows[j]->shear_rate - calm_rows[j]->shear_rate; };
  double largest = 0;
  for (std::size_t j = 1; j + 1 < rows.size(); ++j)
    if (!(std::abs(excess(j - 1) - 2 * excess(j) + excess(j + 1)) / 4 <= amplitude))
      largest = std::max(largest, calm_rows[j]->shear_rate);
  return largest;
}

void add_chatter_kind(std::vector<CheckKind>& kinds) {
  kinds.push_back({"chatter", read_chatter, evaluate_chatter});
}

}  // namespace verification
