#include "verification/runs/scheme_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "verification/config/config_error.hpp"
#include "verification/not_a_number.hpp"

namespace verification {
namespace {

/// Smallest usable error of the ladder behind an order.
double smallest_error(const StudyData& data, const reports::OrderRecord& order) {
  double smallest = nan;
  for (const reports::LevelRecord& level : data.levels)
    if (level.variant == order.variant && level.location == order.location && level.norm == order.norm &&
        level.t == order.t && !(level.value >= smallest))
      smallest = level.value;
  return smallest;
}

std::string reason(const mpm::FormalOrder& formal, Axis axis) {
  if (formal.remap_space > 0 && axis == Axis::Time)
    return "loses ~ h^" + std::to_string(static_cast<int>(formal.remap_space)) +
           "/dt a second: the error grows as dt shrinks, by 1/dt while it is small, and no order in dt "
           "exists (the law "
           "is checked in studies remap-*). Shown: slope and smallest of the error against the exact "
           "solution";
  if (formal.remap_space > 0) return "the remap's loss ~ h^r/dt takes part";
  return "";
}

}  // namespace

mpm::FormalOrder formal_order(const SceneConfig& scene) {
  if (scene.incompressible) throw ConfigError("a [matrix] holds weakly compressible schemes alone");
  return scene.sph ? mpm::formal_order(*scene.sph) : mpm::formal_order(scene.scheme);
}

double formal_dt_exponent(const mpm::FormalOrder& formal) {
  return std::max(
      2.0, formal.space / formal.time);  // at least 2, so that nu dt/h^2 stays below the explicit limit
}

double expected_order(const mpm::FormalOrder& formal, Axis axis, double dt_exponent, Location location) {
  if (axis == Axis::Time) return formal.remap_space > 0 ? nan : formal.time;
  const double space = location == Location::Grid ? formal.space : formal.space_particles;
  double order = std::min(space, formal.time * dt_exponent);
  if (formal.remap_space > 0) order = std::min(order, formal.remap_space - dt_exponent);
  return order;
}

ExactErrorSlope exact_error_slope(const StudyData& data, const reports::OrderRecord& order) {
  std::vector<double> steps, errors;
  for (const RunData* run : data.runs_of(order.variant)) {
    steps.push_back(run->plan->step);
    for (const reports::ErrorRecord& error : run->errors)
      if (error.t == order.t && error.location == order.location) errors.push_back(error.l2);
  }
  return {estimate_order(steps, errors), *std::ranges::min_element(errors)};
}

std::vector<reports::MatrixRecord> matrix_records(const StudyData& data) {
  std::vector<reports::MatrixRecord> records;
  if (!data.study->matrix) return records;
  for (const reports::OrderRecord& order : data.orders) {
    const RunData& run = *data.runs_of(order.variant).front();
    if (run.plan->scene.incompressible || order.norm != "l2" || order.t != run.plan->scene.outputs.back())
      continue;
    const Axis axis = data.study->ladder.axis;
    const mpm::FormalOrder formal = formal_order(run.plan->scene);
    reports::MatrixRecord record{
        run.record.basis,    run.record.transfer, run.record.stepping,         run.record.scene,
        order.axis,          order.location,      order.theoretical,           order.observed,
        order.ci_lower,      order.ci_upper,      smallest_error(data, order), "",
        reason(formal, axis)};
    const std::string suffix = order.variant + ": formal " + order.axis + " order, " + order.location;
    for (const reports::CheckRecord& check : data.checks)
      if (check.check.starts_with(suffix)) record.verdict = check.verdict;
    if (std::isnan(order.theoretical)) {
      const ExactErrorSlope slope = exact_error_slope(data, order);
      record.observed = slope.estimate.order;
      record.ci_lower = slope.estimate.has_interval ? slope.estimate.lower : nan;
      record.ci_upper = slope.estimate.has_interval ? slope.estimate.upper : nan;
      record.smallest_error = slope.smallest_error;
      if (record.verdict == "pass") record.verdict = "grows as dt shrinks";
    }
    records.push_back(record);
  }
  return records;
}

}  // namespace verification
