#include "verification/validation/validated_quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace verification {
namespace {

using ValidatedRow = reports::ProfileRow;

/// Samples of one time on the points of a lattice.
struct Lattice {
  std::vector<double> x, y;
  std::vector<const ValidatedRow*> rows;  // x runs fastest

  [[nodiscard]] const ValidatedRow& at(std::size_t i, std::size_t j) const { return *rows[j * x.size() + i]; }
};

std::vector<double> distinct_values(std::vector<double> values) {
  std::ranges::sort(values);
  const double same = 1e-9 * std::max(std::abs(values.front()), std::abs(values.back()));
  std::vector<double> kept;
  for (const double value : values)
    if (kept.empty() || value - kept.back() > same) kept.push_back(value);
  return kept;
}

Lattice lattice_at(const RunFiles& run, double t) {
  Lattice lattice;
  std::vector<double> xs, ys, times;
  for (const ValidatedRow& row : *run.profile) {
    if (row.location != "grid") continue;
    times.push_back(row.t);
    if (std::abs(row.t - t) > 1e-9 * t) continue;
    lattice.rows.push_back(&row);
    xs.push_back(row.x);
    ys.push_back(row.y);
  }
  if (times.empty())
    throw std::invalid_argument("the run has no samples of the grid field (location 'grid')");
  if (lattice.rows.empty()) {
    const auto [first, last] = std::ranges::minmax(times);
    throw std::invalid_argument(
        fmt::format("t = {:g} s is no output time of the run (they lie from {:g} to {:g} s); add it to "
                    "time.outputs: nothing "
                    "is interpolated or extrapolated in time",
                    t, first, last));
  }
  lattice.x = distinct_values(xs);
  lattice.y = distinct_values(ys);
  if (lattice.x.size() * lattice.y.size() != lattice.rows.size())
    throw std::invalid_argument(
        "the run's grid samples do not fill a lattice of lines x and y; write them on one");
  // To 1e-9 of the extent two samples are on one line: sort by the line, not by the bits.
  const auto line_of = [](const std::vector<double>& lines, double value) {
    const auto above = std::ranges::upper_bound(lines, value);
    if (above == lines.begin()) return std::ptrdiff_t{0};
    const auto below = above - 1;
    const bool nearer_above = above != lines.end() && *above - value < value - *below;
    return (nearer_above ? above : below) - lines.begin();
  };
  std::ranges::sort(lattice.rows, {}, [&](const ValidatedRow* row) {
    return std::pair(line_of(lattice.y, row->y), line_of(lattice.x, row->x));
  });
  return lattice;
}

/// Places of up to four neighbouring lines about `value`, and the weights of the polynomial through them.
struct Interpolation {
  std::size_t first = 0;
  std::vector<double> weights;
};

Interpolation interpolation(const std::vector<double>& lines, double value, const char* direction) {
  const double slack = 1e-9 * (lines.back() - lines.front());
  if (!(value >= lines.front() - slack && value <= lines.back() + slack))
    throw std::invalid_argument(
        fmt::format("{0} = {1:g} m lies outside of the run's samples ({2:g} to {3:g} m): nothing is "
                    "extrapolated; correct the "
                    "place or its scale, or take the row out",
                    direction, value, lines.front(), lines.back()));
  const std::size_t count = std::min<std::size_t>(4, lines.size());
  const auto above = static_cast<std::size_t>(std::ranges::lower_bound(lines, value) - lines.begin());
  Interpolation result;
  result.first = std::min(above > count / 2 ? above - count / 2 : 0, lines.size() - count);
  for (std::size_t i = 0; i < count; ++i) {
    double weight = 1;
    for (std::size_t k = 0; k < count; ++k)
      if (k != i)
        weight *= (value - lines[result.first + k]) / (lines[result.first + i] - lines[result.first + k]);
    result.weights.push_back(weight);
  }
  return result;
}

/// The sample of the grid field at a place, where there is one; null where there is none.
const ValidatedRow* sample_at(const RunFiles& run, const Whereabouts& where) {
  for (const ValidatedRow& row : *run.profile)
    if (row.location == "grid" && std::abs(row.t - where.t) <= 1e-9 * where.t &&
        std::abs(row.x - where.x) <= 1e-9 * std::abs(where.x) &&
        std::abs(row.y - where.y) <= 1e-9 * std::abs(where.y))
      return &row;
  return nullptr;
}

double field(const RunFiles& run, const Whereabouts& where, double ValidatedRow::*component) {
  if (const ValidatedRow* sample = sample_at(run, where)) return sample->*component;
  const Lattice lattice = lattice_at(run, where.t);
  const Interpolation across = interpolation(lattice.y, where.y, "y");
  const Interpolation along =
      std::isnan(where.x) ? Interpolation{0, {1.0}} : interpolation(lattice.x, where.x, "x");
  double value = 0;
  for (std::size_t j = 0; j < across.weights.size(); ++j)
    for (std::size_t i = 0; i < along.weights.size(); ++i)
      value +=
          across.weights[j] * along.weights[i] * (lattice.at(along.first + i, across.first + j).*component);
  return value;
}

/// Integral over y of the cubic through neighbouring samples of the first column: Gauss-Legendre with two
/// points an interval is exact for it.
double flow_rate(const Lattice& lattice) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < lattice.y.size(); ++k)
    for (const double side : {-1.0, 1.0}) {
      const double width = lattice.y[k + 1] - lattice.y[k];
      const double y = lattice.y[k] + width * (0.5 + 0.5 * side / std::sqrt(3.0));
      const Interpolation across = interpolation(lattice.y, y, "y");
      for (std::size_t j = 0; j < across.weights.size(); ++j)
        sum += 0.5 * width * across.weights[j] * lattice.at(0, across.first + j).u;
    }
  return sum;
}

/// Derivative at the first line of the polynomial through the first four.
double wall_shear_rate(const Lattice& lattice) {
  const std::size_t count = std::min<std::size_t>(4, lattice.y.size());
  if (count < 2) throw std::invalid_argument("a shear rate needs samples on two lines y at least");
  const double y0 = lattice.y[0];
  double slope = 0;
  for (std::size_t i = 1; i < count; ++i) {
    double weight = 1 / (lattice.y[i] - y0);
    for (std::size_t k = 1; k < count; ++k)
      if (k != i) weight *= (y0 - lattice.y[k]) / (lattice.y[i] - lattice.y[k]);
    slope += weight * (lattice.at(0, i).u - lattice.at(0, 0).u);
  }
  return std::abs(slope);
}

/// A member of the rows of a record by sample, linear between them.
template <class Row>
double in_time(const std::vector<Row>* rows, double t, double Row::*value, const char* record) {
  if (!rows || rows->size() < 2) throw std::invalid_argument(fmt::format("the run has no {}", record));
  const double slack = 1e-9 * rows->back().t;
  if (t < rows->front().t - slack || t > rows->back().t + slack)
    throw std::invalid_argument(
        fmt::format("t = {:g} s lies outside of the run's {} ({:g} to {:g} s): nothing is extrapolated; run "
                    "it on, or take the row out",
                    t, record, rows->front().t, rows->back().t));
  std::size_t k = 1;
  while (k + 1 < rows->size() && (*rows)[k].t < t) ++k;
  const Row &before = (*rows)[k - 1], &after = (*rows)[k];
  const double f = (t - before.t) / (after.t - before.t);
  return (1 - f) * before.*value + f * after.*value;
}

double probe_velocity(const RunFiles& run, const Whereabouts& where) {
  return in_time(run.history, where.t, &reports::HistoryRow::probe, "history");
}

double reached(const RunFiles& run, const Whereabouts& where, double reports::SurfaceRow::*value) {
  return in_time(run.surface, where.t, value, "record of a free surface");
}

constexpr std::array<ValidatedQuantity, 8> quantities = {{
    {"u", "m/s", true, false, 1, 0,
     [](const RunFiles& r, const Whereabouts& w) { return field(r, w, &ValidatedRow::u); }},
    {"v", "m/s", true, false, 1, 0,
     [](const RunFiles& r, const Whereabouts& w) { return field(r, w, &ValidatedRow::v); }},
    {"flow-rate", "m2/s", false, false, 1, 1,
     [](const RunFiles& r, const Whereabouts& w) { return flow_rate(lattice_at(r, w.t)); }},
    {"mean-velocity", "m/s", false, false, 1, 0,
     [](const RunFiles& r, const Whereabouts& w) {
       const Lattice lattice = lattice_at(r, w.t);
       return flow_rate(lattice) / (lattice.y.back() - lattice.y.front());
     }},
    {"wall-shear-rate", "1/s", false, false, 1, -1,
     [](const RunFiles& r, const Whereabouts& w) { return wall_shear_rate(lattice_at(r, w.t)); }},
    {"probe", "m/s", false, false, 1, 0, probe_velocity},
    {"front", "m", false, true, 0, 1,
     [](const RunFiles& r, const Whereabouts& w) { return reached(r, w, &reports::SurfaceRow::front); }},
    {"column-height", "m", false, true, 0, 1,
     [](const RunFiles& r, const Whereabouts& w) {
       return reached(r, w, &reports::SurfaceRow::column_height);
     }},
}};

}  // namespace

const ValidatedQuantity* find_validated_quantity(const std::string& name) {
  const auto found = std::ranges::find_if(quantities, [&](const auto& q) { return name == q.name; });
  return found == quantities.end() ? nullptr : &*found;
}

std::string validated_quantity_names() {
  std::string names;
  for (const ValidatedQuantity& quantity : quantities)
    names += (names.empty() ? "" : ", ") + std::string(quantity.name);
  return names;
}

}  // namespace verification
