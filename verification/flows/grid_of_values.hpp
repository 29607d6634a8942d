#pragma once

#include <array>
#include <string>
#include <vector>

#include "verification/flows/flow.hpp"

namespace verification {

/// How values between points are found: straight lines, or the cubic through four neighbours (fourth order; a
/// parabola or less where there are fewer).
enum class Interpolation { Linear, Cubic };

/// Velocities at the points of a rectilinear grid, and between them. Where all points lie on one line, or the
/// flow does not vary along itself, only the place across it counts.
class GridOfValues {
 public:
  struct Row {
    Vec2 place;     ///< [m]
    Vec2 velocity;  ///< [m/s]
  };
  /// `period`: of the box along x and y [m], 0 between walls. `line`: only the place along axis `across`
  /// counts. Throws std::invalid_argument for points that are no grid, or fewer than two.
  GridOfValues(const std::vector<Row>& rows, const Vec2& period, int across, bool line, Interpolation rule);

  /// NaN outside of the points.
  [[nodiscard]] Vec2 at(const Vec2& x) const;

 private:
  struct Weights {
    std::array<std::size_t, 4> index{};
    std::array<double, 4> weight{};
    std::size_t count = 0;  // 0: outside
  };
  [[nodiscard]] Weights weights(int axis, double place) const;

  std::array<std::vector<double>, 2> places_;        // ascending, wrapped around a period
  std::array<std::vector<std::size_t>, 2> sources_;  // which original line each of them is
  std::vector<Vec2> values_;                         // x first
  std::size_t width_ = 0;                            // original lines along x
  Interpolation rule_;
};

}  // namespace verification
