#include "verification/checks/quantities/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "verification/checks/quantities/probe_history.hpp"
#include "verification/checks/quantities/quantity_entries.hpp"

namespace verification {
namespace {

const std::vector<QuantityEntry>& entries() {
  static const std::vector<QuantityEntry> all = [] {
    std::vector<QuantityEntry> list;
    add_probe_quantities(list);
    add_energy_quantities(list);
    add_shear_quantities(list);
    add_oscillation_quantities(list);
    add_particle_quantities(list);
    add_yield_quantities(list);
    add_surface_quantities(list);
    return list;
  }();
  return all;
}

const QuantityEntry& entry(const std::string& name) {
  return *std::ranges::find_if(entries(), [&](const QuantityEntry& e) { return name == e.name; });
}

}  // namespace

const std::vector<std::string>& quantity_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const QuantityEntry& e : entries()) list.emplace_back(e.name);
    return list;
  }();
  return names;
}

bool needs_time(const std::string& quantity) {
  return entry(quantity).time;
}
bool needs_place(const std::string& quantity) {
  return entry(quantity).place;
}
std::string unit_of(const std::string& quantity) {
  return entry(quantity).unit;
}

bool is_quantity(const std::string& name) {
  return std::ranges::count(quantity_names(), name) > 0;
}

Record record_of(const std::string& quantity) {
  return entry(quantity).record;
}

double evaluate(const Quantity& quantity, const RunData& run) {
  return entry(quantity.name).evaluate(quantity, run);
}

double crossing_time(const RunData& a, const RunData& b) {
  double before = 0, t_before = 0;
  for (const reports::HistoryRow& row : a.history) {
    const double difference = row.probe - interpolated(b.history, row.t);
    if (std::isnan(difference)) continue;
    if (before * difference < 0) return t_before + (row.t - t_before) * before / (before - difference);
    if (difference != 0) {
      before = difference;
      t_before = row.t;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace verification
