#include "verification/checks/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>

#include "reports/summaries/work_precision.hpp"
#include "verification/checks/oscillation.hpp"
#include "verification/checks/surface/surface_quantities.hpp"
#include "verification/runs/measures.hpp"

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
  if (!run.completed() || run.history.empty()) return nan;
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

// ---- free and driven oscillations of the probe

std::optional<Oscillation> free_oscillation(const RunData& run) {
  const auto expected = run.plan->scene.flow->oscillation();
  if (!expected || expected->decay_rate == 0 || !run.completed()) return std::nullopt;
  Signal signal;
  for (const reports::HistoryRow& row : run.history) {
    signal.t.push_back(row.t);
    signal.value.push_back(row.probe);
  }
  return fit_damped_oscillation(signal, *expected);
}

double period_error(const RunData& run) {
  const auto fit = free_oscillation(run);
  return fit ? run.plan->scene.flow->oscillation()->angular_frequency / fit->angular_frequency - 1 : nan;
}

double decay_error(const RunData& run) {
  const auto fit = free_oscillation(run);
  return fit ? fit->decay_rate / run.plan->scene.flow->oscillation()->decay_rate - 1 : nan;
}

/// Complex amplitude of the probe over that of the exact solution, both fitted to the last period; NaN where
/// there is none.
std::complex<double> relative_amplitude(const RunData& run) {
  const auto driven = run.plan->scene.flow->oscillation();
  if (!driven || driven->decay_rate != 0 || !run.completed() || run.history.empty()) return nan;
  const double omega = driven->angular_frequency, period = 2 * std::numbers::pi / omega;
  const double begin = run.history.back().t - period * (1 + 1e-9);
  if (begin < run.history.front().t - 1e-6 * period) return nan;
  Signal measured, exact;
  for (const reports::HistoryRow& row : run.history) {
    if (row.t < begin) continue;
    measured.t.push_back(row.t);
    measured.value.push_back(row.probe);
    exact.value.push_back(row.probe_exact);
  }
  exact.t = measured.t;
  const auto ours = fit_harmonic(measured, omega), theirs = fit_harmonic(exact, omega);
  return ours && theirs ? *ours / *theirs : nan;
}

// ---- density, pressure and places of the particles

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

// ---- where particles are

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

// ---- motion where there should be none

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

// ---- yield stress

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

/// Work that no clock measures: the same on every machine.
double particle_steps(const RunData& run) {
  const double count = reports::particle_steps_of(run.record);
  return run.completed() && count > 0 ? count : nan;
}

constexpr auto rate = &reports::ShearRow::shear_rate;
constexpr auto viscosity = &reports::ShearRow::viscosity_ratio;

const std::vector<QuantityEntry> own_entries = {
    {"settling-time", "s", false, false, [](const Quantity&, const RunData& r) { return settling_time(r); }},
    {"final-velocity", "m/s", false, false,
     [](const Quantity&, const RunData& r) {
       return r.completed() && !r.probe.empty() ? r.probe.back() : nan;
     }},
    {"particle-steps", "1", false, false,
     [](const Quantity&, const RunData& r) { return particle_steps(r); }},
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
    {"period-error", "1", false, false, [](const Quantity&, const RunData& r) { return period_error(r); }},
    {"decay-error", "1", false, false, [](const Quantity&, const RunData& r) { return decay_error(r); }},
    {"amplitude-error", "1", false, false,
     [](const Quantity&, const RunData& r) { return std::abs(relative_amplitude(r)) - 1; }},
    {"phase-error", "rad", false, false,
     [](const Quantity&, const RunData& r) { return std::arg(relative_amplitude(r)); }},
    {"pressure-error", "1", true, false,
     [](const Quantity& q, const RunData& r) { return pressure_error(r, q.time); }},
    {"density-error", "1", true, false,
     [](const Quantity& q, const RunData& r) { return density_error(r, q.time); }},
    {"path-error", "cells", true, false,
     [](const Quantity& q, const RunData& r) { return path_error(r, q.time); }},
    {"grid-error", "1", true, false,
     [](const Quantity& q, const RunData& r) { return velocity_error(r, q.time, Location::Grid); }},
    {"particle-error", "1", true, false,
     [](const Quantity& q, const RunData& r) { return velocity_error(r, q.time, Location::Particles); }},
    {"fewest-in-a-cell", "particles", true, false,
     [](const Quantity& q, const RunData& r) { return in_a_cell(r, q.time, true); }},
    {"most-in-a-cell", "particles", true, false,
     [](const Quantity& q, const RunData& r) { return in_a_cell(r, q.time, false); }},
    {"largest-speed", "1", false, false,
     [](const Quantity&, const RunData& r) {
       return largest_speed(r, 0, 1) / r.plan->scene.flow->velocity_scale();
     }},
    {"speed-growth", "1", false, false,
     [](const Quantity&, const RunData& r) { return largest_speed(r, 0.5, 1) / largest_speed(r, 0, 0.5); }},
    {"speed-over-bound", "1", false, false,
     [](const Quantity&, const RunData& r) { return speed_over_bound(r); }},
    {"stopping-time", "s", false, false, [](const Quantity&, const RunData& r) { return stopping_time(r); }},
    {"plug-velocity-error", "1", true, false,
     [](const Quantity& q, const RunData& r) { return plug_velocity_error(r, q.time); }},
    {"plug-height-error", "1", true, false,
     [](const Quantity& q, const RunData& r) { return plug_height_error(r, q.time); }},
    {"energy-drift", "1", false, false,
     [](const Quantity&, const RunData& r) { return r.completed() ? energy_drift(r.history) : nan; }},
};

const std::vector<QuantityEntry>& entries() {
  static const std::vector<QuantityEntry> all = [] {
    std::vector<QuantityEntry> list = own_entries;
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
  const auto one_of = [&](std::initializer_list<const char*> names) {
    return std::ranges::count(names, quantity) > 0;
  };
  if (quantity.starts_with("shear-rate") || quantity == "viscosity-ratio") return Record::Shear;
  if (one_of({"pressure-error", "density-error"})) return Record::State;
  if (one_of({"grid-error", "particle-error", "path-error", "final-velocity", "fewest-in-a-cell",
              "most-in-a-cell", "particle-steps"}))
    return Record::Profile;
  return Record::History;
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
