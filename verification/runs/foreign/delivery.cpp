#include "verification/runs/foreign/delivery.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace verification {
namespace {

using Rows = std::vector<const reports::ProfileRow*>;

/// Widest gap that is borne, in cells: a point a cell, wherever it lies in its cell, leaves gaps below two.
constexpr double widest_gap = 2;
/// Rounding of places in somebody's text, in parts of the domain.
constexpr double place_rounding = 1e-6;

std::array<double, 2> place(const reports::ProfileRow& row) {
  return {row.x, row.y};
}

/// Widest gap between points along an axis, the domain's ends (or, around a period, each other) included.
double gap_along(const Rows& rows, const mpm::Scene& scene, int axis) {
  std::vector<double> places;
  for (const auto* row : rows) places.push_back(place(*row)[static_cast<std::size_t>(axis)]);
  std::ranges::sort(places);
  double widest = scene.periodic(axis) ? places.front() + scene.size[axis] - places.back()
                                       : std::max(places.front(), scene.size[axis] - places.back());
  for (std::size_t k = 1; k < places.size(); ++k) widest = std::max(widest, places[k] - places[k - 1]);
  return widest;
}

/// In flows that vary in both directions: the blocks of 2 x 2 cells that hold no point.
long empty_blocks(const Rows& rows, const mpm::Scene& scene) {
  const auto blocks = [&](int axis) { return std::max(1, scene.cells[static_cast<std::size_t>(axis)] / 2); };
  std::set<std::pair<int, int>> held;
  const auto block = [&](double x, int axis) {
    return std::clamp(static_cast<int>(x / scene.size[axis] * blocks(axis)), 0, blocks(axis) - 1);
  };
  for (const auto* row : rows) held.emplace(block(row->x, 0), block(row->y, 1));
  return static_cast<long>(blocks(0)) * blocks(1) - static_cast<long>(held.size());
}

/// Of a flow that is known at the points of a table alone: the first of them that is not among the rows; ""
/// if they all are.
std::string missing_point(const Rows& rows, const SceneConfig& config) {
  const double near = place_rounding * config.scene.smallest_cell_size();
  for (const Vec2& point : config.flow->tabulated_points())
    if (std::ranges::none_of(rows, [&](const auto* row) {
          return std::hypot(row->x - point.x(), row->y - point.y()) <= near;
        }))
      return fmt::format("the point x = {:.6g}, y = {:.6g} is not there, at which the solution is known",
                         point.x(), point.y());
  return "";
}

std::string check_group(const Rows& rows, const PlannedRun& plan, const ForeignSolver& solver) {
  const SceneConfig& config = plan.scene;
  const mpm::Scene& scene = config.scene;
  const int across = config.flow->across();
  std::set<std::array<double, 2>> places;
  for (const auto* row : rows) {
    if (!std::isfinite(row->u) || !std::isfinite(row->v))
      return fmt::format("the velocity at x = {:g}, y = {:g} is not finite", row->x, row->y);
    for (const int axis : {0, 1}) {
      const double x = place(*row)[static_cast<std::size_t>(axis)], slack = place_rounding * scene.size[axis];
      if (!(x >= -slack && x <= scene.size[axis] + slack))
        return fmt::format("the point x = {:g}, y = {:g} lies outside the domain {:g} x {:g} m", row->x,
                           row->y, scene.size.x(), scene.size.y());
    }
    if (!places.insert(place(*row)).second)
      return fmt::format("the point x = {:g}, y = {:g} is there twice", row->x, row->y);
  }
  const int needed = solver.points_across > 0 ? solver.points_across : config.discretisation.cells;
  if (static_cast<int>(rows.size()) < needed)
    return fmt::format("found {} points; expected at least {}, one a cell across", rows.size(), needed);
  if (rows.front()->location == name(Location::Grid))
    if (std::string lack = missing_point(rows, config); !lack.empty()) return lack;
  const double cell = scene.size[across] / std::min(needed, config.discretisation.cells);
  if (const double gap = gap_along(rows, scene, across); gap > widest_gap * cell * (1 + place_rounding))
    return fmt::format(
        "nothing is delivered over {:.3g} m across the flow; expected no gap wider than two cells, "
        "{:.3g} m",
        gap, widest_gap * cell);
  if (solver.points_across == 0 && !config.flow->has_shear_profile() && config.discretisation.cells_along > 1)
    if (const long empty = empty_blocks(rows, scene); empty > 0)
      return fmt::format("{} blocks of two by two cells hold no point", empty);
  return "";
}

/// What the profile must hold: as declared, else whatever of "grid" and "particles" it does hold; that all
/// runs of a study hold the same is seen where they come together (settle_locations).
std::vector<Location> expected_locations(const std::vector<reports::ProfileRow>& rows,
                                         const ForeignSolver& solver) {
  if (solver.locations_known) return solver.locations;
  std::vector<Location> held;
  for (const Location location : solver.locations)
    if (std::ranges::any_of(rows, [&](const auto& row) { return row.location == name(location); }))
      held.push_back(location);
  return held.empty() ? solver.locations : held;
}

}  // namespace

double output_time(const SceneConfig& scene, double t) {
  double previous = scene.start, best = std::numeric_limits<double>::quiet_NaN();
  for (const double output : scene.outputs) {
    if (std::abs(t - output) <= 1e-6 * (output - previous)) best = output;
    previous = output;
  }
  return best;
}

std::vector<std::string> shortcomings(const std::vector<reports::ProfileRow>& rows, const PlannedRun& plan,
                                      const ForeignSolver& solver) {
  std::vector<std::string> found;
  std::map<std::pair<std::string, double>, Rows> groups;
  std::set<double> times, strange_times;
  std::set<std::string> strange_locations;
  const std::vector<Location> expected = expected_locations(rows, solver);
  for (const reports::ProfileRow& row : rows) {
    const double t = output_time(plan.scene, row.t);
    if (std::isnan(t)) {
      strange_times.insert(row.t);
      continue;
    }
    times.insert(t);
    const auto is_its = [&](Location location) { return name(location) == row.location; };
    if (std::ranges::none_of(expected, is_its))
      strange_locations.insert(row.location);
    else
      groups[{row.location, t}].push_back(&row);
  }
  const bool all_times = times.size() == plan.scene.outputs.size();
  if (!all_times || !strange_times.empty()) {
    std::vector<double> seen(times.begin(), times.end());
    seen.insert(seen.end(), strange_times.begin(), strange_times.end());
    std::ranges::sort(seen);
    if (seen.size() > 8) seen.resize(8);
    found.push_back(seen.empty()
                        ? fmt::format("found no rows; expected t = {}", fmt::join(plan.scene.outputs, ", "))
                        : fmt::format("found t = {}; expected {}", fmt::join(seen, ", "),
                                      fmt::join(plan.scene.outputs, ", ")));
  }
  for (const std::string& location : strange_locations) {
    std::vector<std::string> names;
    for (const Location known : expected) names.push_back(name(known));
    found.push_back(fmt::format("found location '{}'; expected {}", location, fmt::join(names, ", ")));
  }
  for (const Location location : expected)
    for (const double t : plan.scene.outputs) {
      const auto group = groups.find({name(location), t});
      if (group == groups.end()) {
        if (times.contains(t))
          found.push_back(fmt::format("no rows at location {}, t = {}", name(location), t));
        continue;
      }
      const std::string lack = check_group(group->second, plan, solver);
      if (!lack.empty()) found.push_back(fmt::format("{}, t = {}: {}", name(location), t, lack));
    }
  return found;
}

}  // namespace verification
