#include <algorithm>
#include <cmath>

#include "verification/checks/quantities/quantity_entries.hpp"
#include "verification/not_a_number.hpp"

namespace verification {
namespace {

using History = std::vector<reports::HistoryRow>;

double energy_error(const RunData& run) {
  if (!run.completed() || run.history.empty()) return nan;
  double largest = 0;
  for (const reports::HistoryRow& row : run.history) {
    const double error = std::abs(row.kinetic_energy / row.kinetic_energy_exact - 1);
    if (std::isnan(error)) return nan;
    largest = std::max(largest, error);
  }
  return largest;
}

/// Largest root mean square velocity of the particles between two fractions of the history [m/s].
double largest_speed(const RunData& run, double from, double to) {
  if (!run.completed() || run.history.size() < 2) return nan;
  const double begin = run.history.front().t, span = run.history.back().t - begin;
  double largest = 0;
  for (const reports::HistoryRow& row : run.history) {
    const double part = (row.t - begin) / span;
    const double speed = std::sqrt(2 * row.kinetic_energy / row.mass);
    if (part >= from && part <= to && !(speed <= largest)) largest = speed;  // keeps a NaN
  }
  return largest;
}

/// Largest |E(t)/E(middle) - 1| over the second half of the history.
double energy_drift(const History& history) {
  if (history.size() < 3) return nan;
  const double middle = 0.5 * (history.front().t + history.back().t);
  double reference = nan, largest = 0;
  for (const reports::HistoryRow& row : history) {
    if (row.t < middle) continue;
    if (std::isnan(reference)) reference = row.kinetic_energy;
    const double change = std::abs(row.kinetic_energy / reference - 1);
    if (!(change <= largest)) largest = change;  // keeps a NaN
  }
  return largest;
}

}  // namespace

void add_energy_quantities(std::vector<QuantityEntry>& entries) {
  entries.insert(
      entries.end(),
      {
          {"energy-error", "1", Record::History, false, false,
           [](const Quantity&, const RunData& r) { return energy_error(r); }},
          {"largest-speed", "1", Record::History, false, false,
           [](const Quantity&, const RunData& r) {
             return largest_speed(r, 0, 1) / r.plan->scene.flow->velocity_scale();
           }},
          {"speed-growth", "1", Record::History, false, false,
           [](const Quantity&, const RunData& r) {
             return largest_speed(r, 0.5, 1) / largest_speed(r, 0, 0.5);
           }},
          {"energy-drift", "1", Record::History, false, false,
           [](const Quantity&, const RunData& r) { return r.completed() ? energy_drift(r.history) : nan; }},
      });
}

}  // namespace verification
