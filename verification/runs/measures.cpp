#include "verification/runs/measures.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "verification/convergence/eca_hoekstra.hpp"
#include "verification/convergence/gci.hpp"
#include "verification/convergence/norms.hpp"
#include "verification/flows/grid_of_values.hpp"
#include "verification/not_a_number.hpp"
#include "verification/runs/foreign/pairing.hpp"

namespace verification {
namespace {

const char* const norm_names[] = {"l1", "l2", "linf"};

Norms norms_or_nan(const std::vector<Eigen::Vector2d>& errors, double scale) {
  return errors.empty() ? Norms{nan, nan, nan} : error_norms(errors, scale);
}

double pick(const Norms& norms, const std::string& norm) {
  return norm == "l1" ? norms.l1 : norm == "l2" ? norms.l2 : norms.linf;
}

/// The values of a run on the grid at a time, and between them. Throws std::invalid_argument where they are
/// no grid.
GridOfValues grid_of(const RunData& run, double t) {
  std::vector<GridOfValues::Row> rows;
  for (const reports::ProfileRow* row : rows_at(run, t, Location::Grid))
    rows.push_back({{row->x, row->y}, {row->u, row->v}});
  const SceneConfig& scene = run.plan->scene;
  Vec2 period = Vec2::Zero();
  for (const int axis : {0, 1})
    if (scene.scene.periodic(axis)) period[axis] = scene.scene.size[axis];
  return {rows, period, scene.flow->across(), scene.flow->has_shear_profile(), Interpolation::Cubic};
}

}  // namespace

Norms difference_norms(const RunData& a, const RunData& b, double t, Location location) {
  const auto rows_a = rows_at(a, t, location);
  auto rows_b = rows_at(b, t, location);
  std::vector<Eigen::Vector2d> differences;
  if (a.foreign) rows_b = paired_by_place(rows_a, rows_b, pairing_distance(a.plan->scene, location));
  if (rows_a.size() == rows_b.size())
    for (std::size_t i = 0; i < rows_a.size(); ++i)
      differences.emplace_back(rows_a[i]->u - rows_b[i]->u, rows_a[i]->v - rows_b[i]->v);
  return norms_or_nan(differences, a.plan->scene.flow->velocity_scale_at(t));
}

Norms norms_against(const RunData& run, const RunData& finer, double t, Location location) {
  std::vector<Eigen::Vector2d> differences;
  try {
    const GridOfValues grid = grid_of(finer, t);
    for (const reports::ProfileRow* row : rows_at(run, t, location))
      differences.push_back(Vec2(row->u, row->v) - grid.at({row->x, row->y}));
  } catch (const std::invalid_argument&) {
    differences.clear();  // nothing to compare with: NaN
  }
  return norms_or_nan(differences, run.plan->scene.flow->velocity_scale_at(t));
}

namespace {

/// GCI of the three finest levels and Eca-Hoekstra uncertainty of the probe velocity, relative to the scale.
void add_uncertainty(reports::OrderRecord& order, const std::vector<const RunData*>& ladder,
                     std::size_t output, double formal_order) {
  order.gci = order.gci_safety_factor = order.uncertainty = nan;
  std::vector<double> steps, values;
  for (const RunData* run : ladder) {
    steps.push_back(run->plan->step);
    values.push_back(output < run->probe.size() ? run->probe[output] / run->plan->scene.flow->velocity_scale()
                                                : nan);
  }
  order.quantity = "velocity at the probe, grid";
  if (steps.size() >= 3) {
    const GciResult gci = grid_convergence_index({steps.end() - 3, steps.end()},
                                                 {values.end() - 3, values.end()}, formal_order);
    order.gci = gci.uncertainty;
    order.gci_safety_factor = gci.safety_factor;
  }
  if (steps.size() >= 4) order.uncertainty = eca_hoekstra(steps, values, formal_order).uncertainty;
}

void measure_ladder(StudyData& data, const std::string& variant, Location location, const char* norm,
                    std::size_t output) {
  const Ladder& ladder = data.study->ladder;
  const auto runs = data.runs_of(variant);
  const double t = runs.front()->plan->scene.outputs[output];
  std::vector<double> steps, values;
  const bool against_itself = data.study->comparison == Comparison::Finest;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    steps.push_back(runs[k]->plan->step);
    if (against_itself) {
      if (k + 1 < runs.size())
        values.push_back(pick(norms_against(*runs[k], *runs[k + 1], t, location), norm));
    } else if (ladder.axis != Axis::Time) {
      for (const reports::ErrorRecord& error : runs[k]->errors)
        if (error.t == t && error.location == name(location))
          values.push_back(verification::pick(error, norm));
    } else if (k + 1 < runs.size()) {
      values.push_back(pick(difference_norms(*runs[k], *runs[k + 1], t, location), norm));
    }
  }
  OrderOptions options;
  options.floor = ladder.floor;
  const OrderEstimate estimate = ladder.axis != Axis::Time && !against_itself
                                     ? estimate_order(steps, values, options)
                                     : estimate_order_from_differences(steps, values, options);
  for (std::size_t k = 0; k < values.size(); ++k)
    data.levels.push_back({data.study->name, variant, name(ladder.axis), name(location), norm, t, steps[k],
                           values[k], bool(estimate.used[k])});
  reports::OrderRecord order;
  order.study = data.study->name;
  order.variant = variant;
  order.axis = name(ladder.axis);
  order.location = name(location);
  order.norm = norm;
  order.t = t;
  order.theoretical = location == Location::Grid ? runs.front()->plan->theoretical
                                                 : runs.front()->plan->theoretical_particles;
  order.observed = estimate.order;
  order.ci_lower = estimate.has_interval ? estimate.lower : nan;
  order.ci_upper = estimate.has_interval ? estimate.upper : nan;
  order.levels_used = static_cast<long>(estimate.used_count);
  order.levels = static_cast<long>(values.size());
  order.classification = to_string(estimate.convergence);
  for (const double p : estimate.pairwise)
    order.pairwise += (order.pairwise.empty() ? "" : ";") + fmt::format("{:.4f}", p);
  order.gci = order.gci_safety_factor = order.uncertainty = nan;
  if (ladder.axis == Axis::Space && location == Location::Grid && order.theoretical >= 1)
    add_uncertainty(order, runs, output, order.theoretical);
  data.orders.push_back(order);
}

}  // namespace

double pick(const reports::ErrorRecord& error, const std::string& norm) {
  return pick(Norms{error.l1, error.l2, error.linf}, norm);
}

std::vector<const reports::ProfileRow*> rows_at(const RunData& run, double t, Location location) {
  std::vector<const reports::ProfileRow*> rows;
  const std::string wanted = name(location);
  for (const reports::ProfileRow& row : run.profile)
    if (row.t == t && row.location == wanted) rows.push_back(&row);
  return rows;
}

std::vector<reports::ErrorRecord> measure_errors(const RunData& run) {
  std::vector<reports::ErrorRecord> records;
  const bool is_tabulated = !run.plan->scene.flow->tabulated_points().empty();
  for (const double t : run.plan->scene.outputs) {
    for (const Location location : {Location::Grid, Location::Particles}) {
      std::vector<Eigen::Vector2d> errors;
      double exact_max = nan;
      for (const reports::ProfileRow* row : rows_at(run, t, location)) {
        const double exact = std::hypot(row->u_exact, row->v_exact);
        if (!(exact <= exact_max) && !std::isnan(exact)) exact_max = exact;
        const bool is_outside = std::isnan(row->u_exact) && std::isnan(row->v_exact);
        if (is_tabulated && is_outside && location == Location::Grid)
          continue;  // no point of the table: a foreign solver's own
        if (!is_tabulated || location == Location::Particles)
          errors.emplace_back(row->u - row->u_exact, row->v - row->v_exact);
        else
          errors.emplace_back(std::isnan(row->u_exact) ? 0 : row->u - row->u_exact,
                              std::isnan(row->v_exact) ? 0 : row->v - row->v_exact);
      }
      const double scale = run.plan->scene.flow->velocity_scale_at(t);
      const Norms norms = norms_or_nan(errors, scale);
      records.push_back(
          {run.record.run, t, name(location), norms.l1, norms.l2, norms.linf, scale, exact_max});
    }
  }
  return records;
}

void compare_with_finest(StudyData& data) {
  if (data.study->comparison != Comparison::Finest) return;
  std::map<std::string, const RunData*> finest;
  for (const RunData& run : data.runs) finest[run.plan->variant] = &run;  // coarse to fine
  for (RunData& run : data.runs) {
    const RunData& finer = *finest.at(run.plan->variant);
    if (&finer == &run) {
      run.errors.clear();
      continue;
    }
    for (reports::ErrorRecord& error : run.errors) {
      const Location location = error.location == name(Location::Grid) ? Location::Grid : Location::Particles;
      const Norms norms = norms_against(run, finer, error.t, location);
      error.l1 = norms.l1;
      error.l2 = norms.l2;
      error.linf = norms.linf;
    }
  }
}

void measure_orders(StudyData& data) {
  if (data.study->ladder.axis == Axis::None) return;
  for (const std::string& variant : data.study->variants) {
    const std::size_t outputs = data.runs_of(variant).front()->plan->scene.outputs.size();
    for (const Location location : {Location::Grid, Location::Particles})
      for (const char* norm : norm_names)
        for (std::size_t output = 0; output < outputs; ++output)
          measure_ladder(data, variant, location, norm, output);
  }
}

}  // namespace verification
