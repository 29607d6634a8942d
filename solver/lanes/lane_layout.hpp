#pragma once

#include <algorithm>

#include "solver/grid/grid.hpp"
#include "solver/kernel/threads/sweep.hpp"
#include "solver/scene/scene.hpp"

namespace mpm {

/// How a scene lies in the kernel: which axis runs along the lanes of a vector (component 0) and which across
/// them (component 1), and where its nodes are in NodeFields.
class LaneLayout {
 public:
  /// `grid`, for its axes, has to outlive the layout.
  LaneLayout(const Scene& scene, const Grid& grid, int degree)
      : grid_(&grid), degree_(degree), lane_axis_(lane_axis(scene)) {}

  /// Component of the kernel <-> axis of the scene.
  [[nodiscard]] int axis_of(int c) const { return c == 0 ? lane_axis_ : 1 - lane_axis_; }
  [[nodiscard]] const Axis& axis(int c) const { return axis_of(c) == 0 ? grid_->x : grid_->y; }

  /// One periodic cell across the lanes, in which nothing varies.
  [[nodiscard]] bool is_strip() const { return axis(1).periodic && axis(1).cells == 1; }

  [[nodiscard]] Sweep::Lines lines() const {
    return {axis(1).cells, stride(), is_strip() ? 0 : degree_, axis(1).periodic && !is_strip()};
  }

  /// Nodes of a row and rows of nodes, images of periodic nodes included.
  [[nodiscard]] int stride() const { return axis(0).cells + degree_; }
  [[nodiscard]] int rows() const { return axis(1).cells + (is_strip() ? 0 : degree_); }

  /// Number in the kernel of the node with functions k along and l across the lanes, counted along the axes.
  [[nodiscard]] int node(int k, int l) const { return l * stride() + k; }

  /// Index in Grid of the node that is the i-th along and the j-th across the lanes.
  [[nodiscard]] std::size_t grid_index(int i, int j) const {
    const int x = lane_axis_ == 0 ? i : j, y = lane_axis_ == 0 ? j : i;
    return static_cast<std::size_t>(y * grid_->x.count() + x);
  }

 private:
  /// Lanes lie along the shorter side, so that the rows between two passes of a sweep stay in the cache,
  /// unless it is so short that the gaps between its rows waste more than a sweep gains.
  static int lane_axis(const Scene& scene) {
    const auto [x, y] = scene.cells;
    const int shorter = y >= x ? 0 : 1, short_side = std::min(x, y);
    const bool is_swept = static_cast<long>(x) * y > Sweep::cells_in_cache;
    return short_side >= (is_swept ? 4 : 16) ? shorter : 1 - shorter;
  }

  const Grid* grid_;
  int degree_, lane_axis_;
};

}  // namespace mpm
