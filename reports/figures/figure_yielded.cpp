#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/figures.hpp"
#include "reports/files/io_error.hpp"
#include "reports/records/directory/run_files.hpp"
#include "reports/records/not_a_number.hpp"

namespace reports {
namespace {

/// Grid velocities of a run on a lattice of (n + 1)^2 points, and what follows from them.
struct Lattice {
  std::vector<double> places;  // of both axes [m]
  std::vector<double> u, v;    // x fastest [m/s]

  [[nodiscard]] std::size_t n() const { return places.size() - 1; }
  [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const { return i + places.size() * j; }

  /// sqrt(2 D:D) at the middle of a square, from its corners [1/s].
  [[nodiscard]] double shear_rate(std::size_t i, std::size_t j) const {
    const double h = places[1] - places[0];
    const auto along_x = [&](const std::vector<double>& f) {
      return (f[at(i + 1, j)] + f[at(i + 1, j + 1)] - f[at(i, j)] - f[at(i, j + 1)]) / (2 * h);
    };
    const auto along_y = [&](const std::vector<double>& f) {
      return (f[at(i, j + 1)] + f[at(i + 1, j + 1)] - f[at(i, j)] - f[at(i + 1, j)]) / (2 * h);
    };
    const double shear = along_y(u) + along_x(v);
    return std::sqrt(2 * std::pow(along_x(u), 2) + 2 * std::pow(along_y(v), 2) + shear * shear);
  }

  /// Stream function: u along each column, from the floor up by the trapezoidal rule [m2/s].
  [[nodiscard]] std::vector<double> stream_function() const {
    std::vector<double> psi(u.size(), 0);
    for (std::size_t j = 1; j <= n(); ++j)
      for (std::size_t i = 0; i <= n(); ++i)
        psi[at(i, j)] =
            psi[at(i, j - 1)] + 0.5 * (places[j] - places[j - 1]) * (u[at(i, j)] + u[at(i, j - 1)]);
    return psi;
  }
};

Lattice lattice_of(const std::filesystem::path& dir, const std::string& run, double t) {
  std::map<std::pair<double, double>, std::pair<double, double>> values;
  std::set<double> xs, ys;
  for (const ProfileRow& row : read_profile(dir, run)) {
    if (row.t != t || row.location != "grid") continue;
    values[{row.y, row.x}] = {row.u, row.v};
    xs.insert(row.x), ys.insert(row.y);
  }
  if (xs != ys || values.size() != xs.size() * xs.size() || xs.size() < 3)
    throw IoError(fmt::format("profiles/{}.csv: no square lattice of grid velocities at t = {} s", run, t));
  Lattice lattice{{xs.begin(), xs.end()}, {}, {}};
  for (const auto& [place, value] : values) {
    lattice.u.push_back(value.first);
    lattice.v.push_back(value.second);
  }
  return lattice;
}

/// Where f = level, as pieces with gaps: two ends in each triangle that it crosses.
Curve contour(const Lattice& lattice, const std::vector<double>& f, double level, double unit) {
  Curve pieces;
  using Corner = std::pair<std::size_t, std::size_t>;
  const auto triangle = [&](const std::array<Corner, 3>& corner) {
    Curve ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i0, j0] = corner[k];
      const auto [i1, j1] = corner[(k + 1) % 3];
      const double a = f[lattice.at(i0, j0)] - level, b = f[lattice.at(i1, j1)] - level;
      if ((a < 0) == (b < 0)) continue;
      const double s = a / (a - b);
      ends.emplace_back(unit * (lattice.places[i0] + s * (lattice.places[i1] - lattice.places[i0])),
                        unit * (lattice.places[j0] + s * (lattice.places[j1] - lattice.places[j0])));
    }
    if (ends.size() != 2) return;
    pieces.insert(pieces.end(), {ends[0], ends[1], {nan, nan}});
  };
  for (std::size_t j = 0; j < lattice.n(); ++j)
    for (std::size_t i = 0; i < lattice.n(); ++i) {
      triangle({Corner{i, j}, Corner{i + 1, j}, Corner{i + 1, j + 1}});
      triangle({Corner{i, j}, Corner{i + 1, j + 1}, Corner{i, j + 1}});
    }
  return pieces;
}

/// Squares in which the fluid does not yield, joined along rows.
Curve unyielded(const Lattice& lattice, double rate, double unit) {
  Curve area;
  for (std::size_t j = 0; j < lattice.n(); ++j)
    for (std::size_t i = 0, end = 0; i < lattice.n(); i = end) {
      const bool solid = lattice.shear_rate(i, j) < rate;
      for (end = i + 1; end < lattice.n() && (lattice.shear_rate(end, j) < rate) == solid;) ++end;
      if (!solid) continue;
      const double x0 = unit * lattice.places[i], x1 = unit * lattice.places[end],
                   y0 = unit * lattice.places[j], y1 = unit * lattice.places[j + 1];
      area.insert(area.end(), {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {nan, nan}});
    }
  return area;
}

}  // namespace

Figure yielded_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results) {
  const std::vector<LabelledRun> runs = runs_of(record, results);
  const std::vector<std::string> rates = split_list(record.component);
  if (rates.size() != runs.size())
    throw IoError(fmt::format("figures.csv: figure '{}' has {} rates for {} runs", record.figure,
                              rates.size(), runs.size()));
  std::vector<FigureScript> panels;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (runs[r].run->status != "completed") continue;
    const Lattice lattice = lattice_of(dir, runs[r].run->run, record.t);
    const Unit length = readable_length(lattice.places.back());
    FigureScript script(runs[r].label, fmt::format("x [{}]", length.name),
                        fmt::format("y [{}]", length.name));
    const double end = length.factor * lattice.places.back();
    script.x_range(0, end);
    script.y_range(0, end);
    script.statement("set size ratio -1");
    script.areas(unyielded(lattice, std::stod(rates[r]), length.factor), "#b9c4cc",
                 "does not yield: stress below the yield stress");
    const std::vector<double> psi = lattice.stream_function();
    const auto [least, most] = std::ranges::minmax(psi);
    Curve lines;
    for (int k = 1; k < 10; ++k) {
      const Curve line = contour(lattice, psi, least + (most - least) * k / 10, length.factor);
      lines.insert(lines.end(), line.begin(), line.end());
    }
    script.line(lines, curve_colour(0), "stream lines", 1);
    panels.push_back(script);
  }
  Figure figure;
  if (panels.empty()) return figure;
  figure.script = panels_text(record.figure, record.title, panels, 2);
  figure.caption = fmt::format(
      "t = {:.4g} s. Grey: the stress of the regularised fluid, from the grid field's "
      "shear rate, is below the yield stress. Nine stream lines, evenly spaced.",
      record.t);
  return figure;
}

}  // namespace reports
