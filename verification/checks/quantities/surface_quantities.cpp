#include <algorithm>
#include <cmath>
#include <limits>

#include "verification/checks/quantities/quantity_entries.hpp"
#include "verification/not_a_number.hpp"
#include "verification/runs/measures.hpp"

namespace verification {
namespace {

/// Largest coordinate along an axis of the particles with x < below, to the edge of what a particle fills.
double reach(const RunData& run, double t, int axis, double below) {
  const SceneConfig& scene = run.plan->scene;
  double largest = nan;
  for (const reports::ProfileRow* row : rows_at(run, t, Location::Particles)) {
    const double x = axis == 0 ? row->x : row->y;
    if (row->x < below && !(x <= largest)) largest = x;
  }
  const auto a = static_cast<std::size_t>(axis);
  return largest + 0.5 * scene.scene.cell_size(axis) / scene.scene.particles_per_cell[a];
}

double front(const RunData& run, double t) {
  return reach(run, t, 0, std::numeric_limits<double>::infinity());
}

double column_height(const RunData& run, double t) {
  return reach(run, t, 1, run.plan->scene.scene.cell_size(0));
}

/// Least-squares slope of y over x.
double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double x_mean = 0, y_mean = 0, covariance = 0, variance = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    x_mean += x[i] / n;
    y_mean += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    covariance += (x[i] - x_mean) * (y[i] - y_mean);
    variance += (x[i] - x_mean) * (x[i] - x_mean);
  }
  return covariance / variance;
}

/// Least-squares slope of the front over the output times, relative to the velocity scale.
double front_slope(const RunData& run) {
  const std::vector<double>& times = run.plan->scene.outputs;
  if (!run.completed() || times.size() < 2) return nan;
  std::vector<double> places;
  for (const double t : times) places.push_back(front(run, t));
  return slope_of(times, places) / run.plan->scene.flow->velocity_scale();
}

/// Over the front that theory has at that time, less one.
double front_error(const RunData& run, double t) {
  const auto theory = run.plan->scene.flow->spreading();
  return theory ? front(run, t) / theory->front(t) - 1 : nan;
}

/// Exponent p of the front x ~ (age + t)^p over the output times, over that of theory, less one.
double front_exponent_error(const RunData& run) {
  const auto theory = run.plan->scene.flow->spreading();
  const std::vector<double>& times = run.plan->scene.outputs;
  if (!theory || !run.completed() || times.size() < 2) return nan;
  std::vector<double> ages, places;
  for (const double t : times) {
    ages.push_back(std::log(theory->age + t));
    places.push_back(std::log(front(run, t)));
  }
  return slope_of(ages, places) / theory->exponent - 1;
}

/// Largest growth of kinetic, potential and elastic energy together over the one at the start.
double energy_growth(const RunData& run) {
  if (!run.completed() || run.surface.empty()) return nan;
  double largest = 0;
  for (const reports::SurfaceRow& row : run.surface) {
    const double growth = row.energy() / run.surface.front().energy() - 1;
    if (!(growth <= largest)) largest = growth;  // keeps a NaN
  }
  return largest;
}

/// Energy at the end of the run over the one at the start, less one.
double energy_change(const RunData& run) {
  if (!run.completed() || run.surface.empty()) return nan;
  return run.surface.back().energy() / run.surface.front().energy() - 1;
}

}  // namespace

void add_surface_quantities(std::vector<QuantityEntry>& entries) {
  entries.push_back({"front", "m", Record::Profile, true, false,
                     [](const Quantity& q, const RunData& r) { return front(r, q.time); }});
  entries.push_back({"front-slope", "1", Record::Profile, false, false,
                     [](const Quantity&, const RunData& r) { return front_slope(r); }});
  entries.push_back({"front-error", "1", Record::Profile, true, false,
                     [](const Quantity& q, const RunData& r) { return front_error(r, q.time); }});
  entries.push_back({"front-exponent-error", "1", Record::Profile, false, false,
                     [](const Quantity&, const RunData& r) { return front_exponent_error(r); }});
  entries.push_back({"column-height", "m", Record::Profile, true, false,
                     [](const Quantity& q, const RunData& r) { return column_height(r, q.time); }});
  entries.push_back({"energy-growth", "1", Record::History, false, false,
                     [](const Quantity&, const RunData& r) { return energy_growth(r); }});
  entries.push_back({"energy-change", "1", Record::History, false, false,
                     [](const Quantity&, const RunData& r) { return energy_change(r); }});
}

}  // namespace verification
