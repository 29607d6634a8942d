#include <cmath>

#include "verification/checks/quantities/probe_history.hpp"
#include "verification/checks/quantities/quantity_entries.hpp"
#include "verification/checks/quantities/shear_cells.hpp"
#include "verification/not_a_number.hpp"

namespace verification {
namespace {

using History = std::vector<reports::HistoryRow>;

double speed_of(const reports::HistoryRow& row) {
  return std::sqrt(2 * row.kinetic_energy / row.mass);
}

/// Largest root mean square velocity over the one that the flow's own inequality allows at that time.
double speed_over_bound(const RunData& run) {
  if (!run.completed() || run.history.size() < 2) return nan;
  const double start = speed_of(run.history.front());
  double largest = 0;
  for (const reports::HistoryRow& row : run.history) {
    if (row.t == run.history.front().t) continue;
    const double ratio =
        speed_of(row) / run.plan->scene.flow->speed_bound(start, row.t - run.history.front().t);
    if (!(ratio <= largest)) largest = ratio;  // keeps a NaN
  }
  return largest;
}

/// When the root mean square velocity has fallen to a hundredth of the one at the start.
double stopping_time(const RunData& run) {
  if (!run.completed()) return nan;
  const History& history = run.history;
  for (std::size_t k = 1; k < history.size(); ++k) {
    const double level = 0.01 * speed_of(history.front());
    const double before = speed_of(history[k - 1]) - level, after = speed_of(history[k]) - level;
    if (after <= 0) return history[k - 1].t + (history[k].t - history[k - 1].t) * before / (before - after);
  }
  return nan;
}

/// Velocity of the probe over that of the ideal fluid, less one; the probe must lie in the plug.
double plug_velocity_error(const RunData& run, double t) {
  const Flow& flow = *run.plan->scene.flow;
  const auto ideal = flow.ideal();
  const auto plug = flow.ideal_plug();
  const Probe probe = flow.probe();
  const double place = probe.point[flow.across()];
  if (!ideal || !plug || !(place >= plug->first && place <= plug->second)) return nan;
  return interpolated(run.history, t) / ideal->velocity(probe.point, t, Location::Grid).dot(probe.direction) -
         1;
}

/// Height over which the stress lies below the yield stress, between cells by interpolation of the stress,
/// over that of the ideal fluid, less one.
double plug_height_error(const RunData& run, double t) {
  const auto plug = run.plan->scene.flow->ideal_plug();
  if (!plug) return nan;
  const FluidConfig& fluid = run.plan->scene.fluid;
  const std::vector<double> rates = cells_at(run, t, &reports::ShearRow::shear_rate);
  const double h = run.plan->scene.cell_size();
  double height = 0;
  for (std::size_t j = 0; j + 1 < rates.size(); ++j) {
    const double a = fluid.curve.stress(rates[j]) / fluid.curve.yielding()->tau_y - 1;
    const double b = fluid.curve.stress(rates[j + 1]) / fluid.curve.yielding()->tau_y - 1;
    if (std::isnan(a) || std::isnan(b)) return nan;
    height += h * (a < 0 && b < 0 ? 1 : a < 0 ? a / (a - b) : b < 0 ? b / (b - a) : 0);
  }
  return rates.empty() ? nan : height / (plug->second - plug->first) - 1;
}

}  // namespace

void add_yield_quantities(std::vector<QuantityEntry>& entries) {
  entries.insert(entries.end(),
                 {
                     {"speed-over-bound", "1", Record::History, false, false,
                      [](const Quantity&, const RunData& r) { return speed_over_bound(r); }},
                     {"stopping-time", "s", Record::History, false, false,
                      [](const Quantity&, const RunData& r) { return stopping_time(r); }},
                     {"plug-velocity-error", "1", Record::History, true, false,
                      [](const Quantity& q, const RunData& r) { return plug_velocity_error(r, q.time); }},
                     {"plug-height-error", "1", Record::History, true, false,
                      [](const Quantity& q, const RunData& r) { return plug_height_error(r, q.time); }},
                 });
}

}  // namespace verification
