#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/figures.hpp"
#include "reports/files/io_error.hpp"

namespace reports {
namespace {

constexpr int tiles = 40;  // of the plane, along either direction

/// Errors on meshes and regularisations; every pair of them has one, or NaN.
struct Plane {
  std::vector<double> log_cells, log_m;  // ascending
  std::map<std::pair<double, double>, double> log_error;

  /// Bilinear between the pairs.
  [[nodiscard]] double at(double x, double y) const {
    const auto below = [](const std::vector<double>& places, double z) {
      const auto after = std::upper_bound(places.begin(), places.end() - 1, z);
      return static_cast<std::size_t>(std::max<long>(0, after - places.begin() - 1));
    };
    const std::size_t i = below(log_cells, x), j = below(log_m, y);
    const double s = (x - log_cells[i]) / (log_cells[i + 1] - log_cells[i]),
                 t = (y - log_m[j]) / (log_m[j + 1] - log_m[j]);
    const auto of = [&](std::size_t a, std::size_t b) {
      const auto found = log_error.find({log_cells[a], log_m[b]});
      return found == log_error.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
    };
    return (1 - t) * ((1 - s) * of(i, j) + s * of(i + 1, j)) +
           t * ((1 - s) * of(i, j + 1) + s * of(i + 1, j + 1));
  }
};

/// Steps of the colours: 1, 2, 5 times powers of ten.
double edge(int k) {
  static constexpr std::array<double, 3> steps = {0, 0.30103, 0.69897};
  const int decade = k >= 0 ? k / 3 : -((2 - k) / 3);
  return decade + steps[static_cast<std::size_t>(k - 3 * decade)];
}
int bin_of(double log_error) {
  int k = static_cast<int>(std::floor(3 * log_error)) - 1;
  while (edge(k + 1) <= log_error) ++k;
  return k;
}

/// From small errors to large ones, from pale to dark: also in grey.
std::string shade(double share) {
  static constexpr std::array<std::array<double, 3>, 3> stops = {
      {{255, 250, 220}, {86, 180, 200}, {20, 30, 90}}};
  const std::size_t k = share < 0.5 ? 0 : 1;
  const double t = 2 * share - static_cast<double>(k);
  std::string text = "#";
  for (std::size_t c = 0; c < 3; ++c)
    text += fmt::format("{:02x}", std::lround(stops[k][c] + t * (stops[k + 1][c] - stops[k][c])));
  return text;
}

}  // namespace

Figure regularisation_figure(const FigureRecord& record, const Results& results) {
  const std::vector<LabelledRun> runs = runs_of(record, results);
  const std::vector<std::string> path_runs = split_list(record.across);
  Plane plane;
  std::set<double> cells, m;
  Curve path, pairs;
  std::vector<double> path_errors;
  for (const LabelledRun& run : runs) {
    double error = std::numeric_limits<double>::quiet_NaN();
    for (const ErrorRecord& row : results.errors)
      if (row.run == run.run->run && row.location == record.location)
        error = record.norm == "l1" ? row.l1 : record.norm == "linf" ? row.linf : row.l2;
    const double x = static_cast<double>(run.run->cells), y = std::stod(run.label);
    if (std::ranges::count(path_runs, run.run->run) > 0) {
      path.emplace_back(x, y);
      path_errors.push_back(error);
      continue;
    }
    pairs.emplace_back(x, y);
    cells.insert(std::log10(x));
    m.insert(std::log10(y));
    plane.log_error[{std::log10(x), std::log10(y)}] = std::log10(error);
  }
  Figure figure;
  if (cells.size() < 2 || m.size() < 2) return figure;
  plane.log_cells.assign(cells.begin(), cells.end());
  plane.log_m.assign(m.begin(), m.end());

  FigureScript script(record.title, "cells across the gap, H/h [-]", "regularisation m [s]");
  script.logarithmic_x();
  script.logarithmic_y();
  std::string ticks;
  for (const double x : cells) {
    const double count = std::round(std::pow(10, x));
    ticks += fmt::format("{}'{:.0f}' {:.0f}", ticks.empty() ? "" : ", ", count, count);
  }
  script.statement("set xtics (" + ticks + ")");
  const auto across = [](const std::vector<double>& places, double k) {
    return places.front() + (places.back() - places.front()) * k / tiles;
  };
  script.x_range(0.999 * std::pow(10, plane.log_cells.front()), std::pow(10, plane.log_cells.back()));
  script.y_range(std::pow(10, plane.log_m.front()), std::pow(10, plane.log_m.back()));
  std::map<int, Curve> areas;  // by step of colour: rectangles, a gap between two
  const double gap = std::numeric_limits<double>::quiet_NaN();
  for (int j = 0; j < tiles; ++j) {
    const double y0 = std::pow(10, across(plane.log_m, j)),
                 y1 = std::pow(10, across(plane.log_m, j + (j + 1 < tiles ? 1.05 : 1)));
    const double y = 0.5 * (across(plane.log_m, j) + across(plane.log_m, j + 1));
    const auto bin = [&](int i) {
      const double error = plane.at(0.5 * (across(plane.log_cells, i) + across(plane.log_cells, i + 1)), y);
      return std::isfinite(error) ? bin_of(error) : std::numeric_limits<int>::min();
    };
    for (int i = 0, end = 0; i < tiles; i = end) {
      const int colour = bin(i);
      for (end = i + 1; end < tiles && bin(end) == colour;) ++end;
      if (colour == std::numeric_limits<int>::min()) continue;
      // A little over the neighbours, or a seam would show between them.
      const double x0 = std::pow(10, across(plane.log_cells, i)),
                   x1 = std::pow(10, across(plane.log_cells, end + (end < tiles ? 0.05 : 0)));
      Curve& area = areas[colour];
      for (const auto& corner : Curve{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {gap, gap}})
        area.push_back(corner);
    }
  }
  if (areas.empty()) return figure;
  const int lowest = areas.begin()->first, highest = areas.rbegin()->first;
  for (const auto& [k, area] : areas)
    script.areas(area, shade(highest == lowest ? 0 : static_cast<double>(k - lowest) / (highest - lowest)),
                 fmt::format("{:.0e} to {:.0e}", std::pow(10, edge(k)), std::pow(10, edge(k + 1))));
  script.points(pairs, "#444444", 7, "", 0.5);
  script.line_and_points(path, curve_colour(1), curve_mark(2).filled, "m from the mesh");
  figure.script = script.text(record.figure);
  figure.caption = fmt::format(
      "Colour: relative {} error of velocity against the ideal fluid, on the {}; dots: the runs that it is "
      "interpolated between.",
      norm_symbol(norm_of(record)), record.location);
  if (!path_errors.empty())
    figure.caption += fmt::format(" Along the line the error falls from {:.2g} to {:.2g}.",
                                  path_errors.front(), path_errors.back());
  return figure;
}

}  // namespace reports
