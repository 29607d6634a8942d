#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/sph/surroundings.hpp"

namespace mpm::sph {

/// Entries sorted into square cells as wide as the reach, and for every fluid particle the entries within it.
class NeighbourList {
 public:
  /// Lists all entries closer than `reach` [m] to each of the first `fluid` of them, those before
  /// `wall_begin` first.
  void rebuild(const std::vector<Neighbour>& entries, std::size_t fluid, std::size_t wall_begin,
               double reach);

  [[nodiscard]] std::span<const std::uint32_t> inner(std::size_t p) const {
    return {list_.data() + begin_[p], list_.data() + middle_[p]};
  }
  [[nodiscard]] std::span<const std::uint32_t> wall(std::size_t p) const {
    return {list_.data() + middle_[p], list_.data() + begin_[p + 1]};
  }
  [[nodiscard]] std::span<const std::uint32_t> all(std::size_t p) const {
    return {list_.data() + begin_[p], list_.data() + begin_[p + 1]};
  }
  /// Place of a particle's first neighbour in an array with one number a pair.
  [[nodiscard]] std::size_t first_pair(std::size_t p) const { return begin_[p]; }
  [[nodiscard]] std::size_t pairs() const { return list_.size(); }

  /// Calls visit(entry) for every entry in the cells around a point.
  template <class Visit>
  void around(const Vec2& x, const Visit& visit) const {
    const int i = column(x.x()), j = row(x.y());
    for (int jj = std::max(j - 1, 0); jj <= std::min(j + 1, rows_ - 1); ++jj)
      for (int ii = std::max(i - 1, 0); ii <= std::min(i + 1, columns_ - 1); ++ii) {
        const auto cell =
            static_cast<std::size_t>(jj) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(ii);
        for (std::size_t k = cell_begin_[cell]; k < cell_begin_[cell + 1]; ++k) visit(sorted_[k]);
      }
  }

 private:
  [[nodiscard]] int column(double x) const;
  [[nodiscard]] int row(double y) const;

  Vec2 origin_ = Vec2::Zero();
  double width_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::size_t> cell_begin_, begin_, middle_;
  std::vector<std::uint32_t> sorted_, list_;
};

}  // namespace mpm::sph
