#include "solver/sph/neighbour_list.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::sph {

int NeighbourList::column(double x) const {
  return std::clamp(static_cast<int>(std::floor((x - origin_.x()) / width_)), 0, columns_ - 1);
}

int NeighbourList::row(double y) const {
  return std::clamp(static_cast<int>(std::floor((y - origin_.y()) / width_)), 0, rows_ - 1);
}

void NeighbourList::rebuild(const std::vector<Neighbour>& entries, std::size_t fluid, std::size_t wall_begin,
                            double reach) {
  Vec2 low = entries.front().position, high = low;
  for (const Neighbour& entry : entries) {
    low = low.cwiseMin(entry.position);
    high = high.cwiseMax(entry.position);
  }
  origin_ = low;
  width_ = reach;
  columns_ = 1 + static_cast<int>((high.x() - low.x()) / width_);
  rows_ = 1 + static_cast<int>((high.y() - low.y()) / width_);

  const auto cell_of = [&](const Neighbour& entry) {
    return static_cast<std::size_t>(row(entry.position.y())) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column(entry.position.x()));
  };
  cell_begin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const Neighbour& entry : entries) ++cell_begin_[cell_of(entry) + 1];
  for (std::size_t c = 1; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  std::vector<std::size_t> next(cell_begin_.begin(), cell_begin_.end() - 1);
  sorted_.resize(entries.size());
  for (std::size_t e = 0; e < entries.size(); ++e)
    sorted_[next[cell_of(entries[e])]++] = static_cast<std::uint32_t>(e);

  list_.clear();
  begin_.assign(1, 0);
  middle_.clear();
  std::vector<std::uint32_t> walls;
  for (std::size_t p = 0; p < fluid; ++p) {
    walls.clear();
    const Vec2 x = entries[p].position;
    around(x, [&](std::uint32_t e) {
      if (e == p || (entries[e].position - x).squaredNorm() >= reach * reach) return;
      (e < wall_begin ? list_ : walls).push_back(e);
    });
    middle_.push_back(list_.size());
    list_.insert(list_.end(), walls.begin(), walls.end());
    begin_.push_back(list_.size());
  }
}

}  // namespace mpm::sph
