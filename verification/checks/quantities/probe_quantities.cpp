#include <cmath>

#include "reports/summaries/work_precision.hpp"
#include "verification/checks/quantities/probe_history.hpp"
#include "verification/checks/quantities/quantity_entries.hpp"
#include "verification/not_a_number.hpp"

namespace verification {
namespace {

double settling_time(const RunData& run) {
  const double steady = run.plan->scene.flow->steady_probe();
  const auto distance = [&](const reports::HistoryRow& row) {
    return std::abs(row.probe - steady) - 0.01 * std::abs(steady);
  };
  const std::vector<reports::HistoryRow>& history = run.history;
  if (history.size() < 2 || !(distance(history.back()) < 0)) return nan;
  std::size_t k = history.size() - 1;
  while (k > 0 && distance(history[k - 1]) < 0) --k;
  if (k == 0) return history.front().t;
  const double before = distance(history[k - 1]), after = distance(history[k]);
  return history[k - 1].t + (history[k].t - history[k - 1].t) * before / (before - after);
}

/// Work that no clock measures: the same on every machine.
double particle_steps(const RunData& run) {
  const double count = reports::particle_steps_of(run.record);
  return run.completed() && count > 0 ? count : nan;
}

}  // namespace

void add_probe_quantities(std::vector<QuantityEntry>& entries) {
  entries.insert(entries.end(),
                 {
                     {"settling-time", "s", Record::History, false, false,
                      [](const Quantity&, const RunData& r) { return settling_time(r); }},
                     {"final-velocity", "m/s", Record::Profile, false, false,
                      [](const Quantity&, const RunData& r) {
                        return r.completed() && !r.probe.empty() ? r.probe.back() : nan;
                      }},
                     {"velocity", "m/s", Record::History, true, false,
                      [](const Quantity& q, const RunData& r) { return interpolated(r.history, q.time); }},
                     {"particle-steps", "1", Record::Profile, false, false,
                      [](const Quantity&, const RunData& r) { return particle_steps(r); }},
                 });
}

}  // namespace verification
