#include <algorithm>
#include <cmath>

#include "verification/checks/quantities/quantity_entries.hpp"
#include "verification/not_a_number.hpp"
#include "verification/runs/measures.hpp"

namespace verification {
namespace {

std::vector<const reports::StateRow*> states_at(const RunData& run, double t, const char* location) {
  std::vector<const reports::StateRow*> rows;
  for (const reports::StateRow& row : run.state)
    if (row.t == t && row.location == location) rows.push_back(&row);
  return rows;
}

double pressure_error(const RunData& run, double t) {
  const auto rows = states_at(run, t, run.plan->scene.incompressible && !run.foreign ? "cells" : "particles");
  double sum = 0;
  for (const reports::StateRow* row : rows) sum += std::pow(row->pressure - row->pressure_exact, 2);
  return rows.empty()
             ? nan
             : std::sqrt(sum / static_cast<double>(rows.size())) / run.plan->scene.flow->pressure_scale();
}

double density_error(const RunData& run, double t) {
  const auto rows = states_at(run, t, "particles");
  double largest = rows.empty() ? nan : 0;
  for (const reports::StateRow* row : rows) {
    const double error = std::abs(row->density / row->density_exact - 1);
    if (!(error <= largest)) largest = error;  // keeps a NaN
  }
  return largest;
}

/// Distance between two places along one direction, the short way round where it is periodic.
double distance_along(double a, double b, double length, bool periodic) {
  const double d = a - b;
  return periodic ? std::abs(d - length * std::round(d / length)) : std::abs(d);
}

double path_error(const RunData& run, double t) {
  const mpm::Scene& scene = run.plan->scene.scene;
  const auto exact = run.plan->scene.flow->exact({t});
  const auto rows = rows_at(run, t, Location::Particles);
  if (rows.empty() || rows.size() != run.start.size()) return nan;
  double largest = 0;
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const auto place = exact->path(run.start[p], t);
    if (!place) return nan;
    const double distance =
        std::hypot(distance_along(rows[p]->x, place->x(), scene.size.x(), scene.periodic(0)),
                   distance_along(rows[p]->y, place->y(), scene.size.y(), scene.periodic(1)));
    if (!(distance <= largest)) largest = distance;  // keeps a NaN
  }
  return largest / run.plan->scene.cell_size();
}

double velocity_error(const RunData& run, double t, Location location) {
  for (const reports::ErrorRecord& error : run.errors)
    if (error.t == t && error.location == name(location)) return error.l2;
  return nan;
}

/// Fewest or most particles in a cell.
double in_a_cell(const RunData& run, double t, bool fewest) {
  const mpm::Scene& scene = run.plan->scene.scene;
  const auto rows = rows_at(run, t, Location::Particles);
  if (rows.empty()) return nan;
  std::vector<int> count(static_cast<std::size_t>(scene.cells[0]) * static_cast<std::size_t>(scene.cells[1]));
  const auto cell = [&](double x, int axis) {
    const int last = scene.cells[static_cast<std::size_t>(axis)] - 1;
    return std::clamp(static_cast<int>(x / scene.cell_size(axis)), 0, last);
  };
  for (const reports::ProfileRow* row : rows) {
    if (!std::isfinite(row->x) || !std::isfinite(row->y)) return nan;
    ++count[static_cast<std::size_t>(cell(row->x, 0) + scene.cells[0] * cell(row->y, 1))];
  }
  return fewest ? *std::ranges::min_element(count) : *std::ranges::max_element(count);
}

}  // namespace

void add_particle_quantities(std::vector<QuantityEntry>& entries) {
  entries.insert(
      entries.end(),
      {
          {"pressure-error", "1", Record::State, true, false,
           [](const Quantity& q, const RunData& r) { return pressure_error(r, q.time); }},
          {"density-error", "1", Record::State, true, false,
           [](const Quantity& q, const RunData& r) { return density_error(r, q.time); }},
          {"path-error", "cells", Record::Profile, true, false,
           [](const Quantity& q, const RunData& r) { return path_error(r, q.time); }},
          {"grid-error", "1", Record::Profile, true, false,
           [](const Quantity& q, const RunData& r) { return velocity_error(r, q.time, Location::Grid); }},
          {"particle-error", "1", Record::Profile, true, false,
           [](const Quantity& q, const RunData& r) {
             return velocity_error(r, q.time, Location::Particles);
           }},
          {"fewest-in-a-cell", "particles", Record::Profile, true, false,
           [](const Quantity& q, const RunData& r) { return in_a_cell(r, q.time, true); }},
          {"most-in-a-cell", "particles", Record::Profile, true, false,
           [](const Quantity& q, const RunData& r) { return in_a_cell(r, q.time, false); }},
      });
}

}  // namespace verification
