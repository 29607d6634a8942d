#include "verification/checks/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace verification {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using History = std::vector<reports::HistoryRow>;

double interpolated(const History& history, double t) {
  for (std::size_t k = 1; k < history.size(); ++k)
    if (history[k].t >= t && history[k - 1].t <= t) {
      const double f = (t - history[k - 1].t) / (history[k].t - history[k - 1].t);
      return (1 - f) * history[k - 1].probe + f * history[k].probe;
    }
  return nan;
}

double settling_time(const RunData& run) {
  const double steady = run.plan->scene.flow->steady_probe();
  const auto distance = [&](const reports::HistoryRow& row) {
    return std::abs(row.probe - steady) - 0.01 * std::abs(steady);
  };
  const History& history = run.history;
  if (history.size() < 2 || !(distance(history.back()) < 0)) return nan;
  std::size_t k = history.size() - 1;
  while (k > 0 && distance(history[k - 1]) < 0) --k;
  if (k == 0) return history.front().t;
  const double before = distance(history[k - 1]), after = distance(history[k]);
  return history[k - 1].t + (history[k].t - history[k - 1].t) * before / (before - after);
}

double energy_error(const RunData& run) {
  if (!run.completed()) return nan;
  double largest = 0;
  for (const reports::HistoryRow& row : run.history) {
    const double error = std::abs(row.kinetic_energy / row.kinetic_energy_exact - 1);
    if (std::isnan(error)) return nan;
    largest = std::max(largest, error);
  }
  return largest;
}

/// Shear rates (or viscosity ratios) of the cells at a time, from the resting plate up.
std::vector<double> cells_at(const RunData& run, double t, double reports::ShearRow::*value) {
  std::vector<double> values;
  for (const reports::ShearRow& row : run.shear)
    if (row.t == t && row.location == "cells") values.push_back(row.*value);
  return values;
}

double in_cell(const std::vector<double>& cells, double place) {
  if (cells.empty()) return nan;
  const double j = std::clamp(std::floor(place * static_cast<double>(cells.size())), 0.0,
                              static_cast<double>(cells.size() - 1));
  return cells[static_cast<std::size_t>(j)];
}

double smallest_rise(const std::vector<double>& cells, std::size_t begin) {
  if (cells.size() < begin + 2) return nan;
  double rise = std::numeric_limits<double>::infinity();
  for (std::size_t j = begin + 1; j < cells.size(); ++j) rise = std::min(rise, cells[j] - cells[j - 1]);
  return rise / *std::ranges::max_element(cells);
}

double smallest_spread(std::vector<double> cells) {
  const double up = smallest_rise(cells, cells.size() / 2);
  std::ranges::reverse(cells);
  return std::min(up, smallest_rise(cells, cells.size() / 2));
}

double asymmetry(const std::vector<double>& cells) {
  if (cells.empty()) return nan;
  double largest = 0;
  for (std::size_t j = 0; j < cells.size(); ++j)
    largest = std::max(largest, std::abs(cells[j] - cells[cells.size() - 1 - j]));
  return largest / *std::ranges::max_element(cells);
}

struct Entry {
  const char *name, *unit;
  bool time, place;
  double (*evaluate)(const Quantity&, const RunData&);
};

constexpr auto rate = &reports::ShearRow::shear_rate;
constexpr auto viscosity = &reports::ShearRow::viscosity_ratio;

const std::vector<Entry> entries = {
    {"settling-time", "s", false, false, [](const Quantity&, const RunData& r) { return settling_time(r); }},
    {"final-velocity", "m/s", false, false,
     [](const Quantity&, const RunData& r) {
       return r.completed() && !r.probe.empty() ? r.probe.back() : nan;
     }},
    {"energy-error", "1", false, false, [](const Quantity&, const RunData& r) { return energy_error(r); }},
    {"velocity", "m/s", true, false,
     [](const Quantity& q, const RunData& r) { return interpolated(r.history, q.time); }},
    {"shear-rate", "1/s", true, true,
     [](const Quantity& q, const RunData& r) { return in_cell(cells_at(r, q.time, rate), q.place); }},
    {"viscosity-ratio", "1", true, true,
     [](const Quantity& q, const RunData& r) { return in_cell(cells_at(r, q.time, viscosity), q.place); }},
    {"shear-rate-rise", "1", true, false,
     [](const Quantity& q, const RunData& r) { return smallest_rise(cells_at(r, q.time, rate), 0); }},
    {"shear-rate-spread", "1", true, false,
     [](const Quantity& q, const RunData& r) { return smallest_spread(cells_at(r, q.time, rate)); }},
    {"shear-rate-asymmetry", "1", true, false,
     [](const Quantity& q, const RunData& r) { return asymmetry(cells_at(r, q.time, rate)); }},
};

const Entry& entry(const std::string& name) {
  return *std::ranges::find_if(entries, [&](const Entry& e) { return name == e.name; });
}

}  // namespace

const std::vector<std::string>& quantity_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Entry& e : entries) list.emplace_back(e.name);
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
  return nan;
}

}  // namespace verification
