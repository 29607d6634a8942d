#include "verification/flows/grid_of_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace verification {
namespace {

/// Rounding of places in somebody's text, in parts of the grid's extent.
constexpr double rounding = 1e-6;

/// The distinct places, ascending.
std::vector<double> distinct(std::vector<double> places) {
  std::ranges::sort(places);
  const double near = rounding * (places.back() - places.front());
  std::vector<double> kept;
  for (const double place : places)
    if (kept.empty() || place - kept.back() > near) kept.push_back(place);
  return kept;
}

std::size_t nearest(const std::vector<double>& places, double place) {
  return static_cast<std::size_t>(
      std::ranges::min_element(places, {}, [&](double p) { return std::abs(p - place); }) - places.begin());
}

}  // namespace

GridOfValues::GridOfValues(const std::vector<Row>& rows, const Vec2& period, int across, bool line,
                           Interpolation rule)
    : rule_(rule) {
  if (rows.size() < 2) throw std::invalid_argument("fewer than two points");
  for (const int axis : {0, 1}) {
    const auto a = static_cast<std::size_t>(axis);
    std::vector<double> all;
    for (const Row& row : rows) all.push_back(line && axis != across ? 0 : row.place[axis]);
    places_[a] = distinct(all);
    for (std::size_t i = 0; i < places_[a].size(); ++i) sources_[a].push_back(i);
  }
  const std::array<std::vector<double>, 2> own = places_;
  width_ = own[0].size();
  std::vector<char> seen(width_ * own[1].size(), 0);
  values_.resize(seen.size());
  for (const Row& row : rows) {
    const std::size_t i = line && across != 0 ? 0 : nearest(own[0], row.place.x());
    const std::size_t j = line && across != 1 ? 0 : nearest(own[1], row.place.y());
    if (seen[i + width_ * j]) continue;
    seen[i + width_ * j] = 1;
    values_[i + width_ * j] = row.velocity;
  }
  if (std::ranges::count(seen, 0) > 0)
    throw std::invalid_argument(
        "the points are no rectilinear grid, so that nothing can be interpolated between them");
  for (const int axis : {0, 1}) {
    const auto a = static_cast<std::size_t>(axis);
    const std::size_t count = own[a].size();
    if (!(period[axis] > 0) || count < 2) continue;
    const double near = rounding * period[axis];
    for (std::size_t k = 0; k < std::min<std::size_t>(2, count); ++k) {
      const double below = own[a][count - 1 - k] - period[axis], above = own[a][k] + period[axis];
      if (below < places_[a].front() - near) {
        places_[a].insert(places_[a].begin(), below);
        sources_[a].insert(sources_[a].begin(), count - 1 - k);
      }
      if (above > places_[a].back() + near) {
        places_[a].push_back(above);
        sources_[a].push_back(k);
      }
    }
  }
}

GridOfValues::Weights GridOfValues::weights(int axis, double place) const {
  const auto a = static_cast<std::size_t>(axis);
  const std::vector<double>& x = places_[a];
  Weights found;
  if (x.size() == 1) {
    found.count = 1;
    found.weight[0] = 1;
    return found;
  }
  const double near = rounding * (x.back() - x.front());
  if (!(place >= x.front() - near && place <= x.back() + near)) return found;
  const std::size_t wanted = std::min<std::size_t>(rule_ == Interpolation::Linear ? 2 : 4, x.size());
  auto right = static_cast<std::size_t>(std::ranges::upper_bound(x, place) - x.begin());
  right = std::clamp<std::size_t>(right, 1, x.size() - 1);
  const std::size_t half = wanted / 2;
  const std::size_t first = std::min(right > half ? right - half : 0, x.size() - wanted);
  found.count = wanted;
  for (std::size_t k = 0; k < wanted; ++k) {
    double weight = 1;
    for (std::size_t m = 0; m < wanted; ++m)
      if (m != k) weight *= (place - x[first + m]) / (x[first + k] - x[first + m]);
    found.index[k] = sources_[a][first + k];
    found.weight[k] = weight;
  }
  return found;
}

Vec2 GridOfValues::at(const Vec2& x) const {
  const Weights along_x = weights(0, x.x()), along_y = weights(1, x.y());
  if (along_x.count == 0 || along_y.count == 0)
    return Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec2 sum = Vec2::Zero();
  for (std::size_t j = 0; j < along_y.count; ++j)
    for (std::size_t i = 0; i < along_x.count; ++i)
      sum += along_x.weight[i] * along_y.weight[j] * values_[along_x.index[i] + width_ * along_y.index[j]];
  return sum;
}

}  // namespace verification
