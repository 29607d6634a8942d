#pragma once

#include <array>

namespace reference {

/// Rigid translation of a fluid of uniform density through a periodic box: velocity W, density and pressure
/// are constant, and the point that starts at X is at X + W t, wrapped into the box. SI units.
struct Translation {
  std::array<double, 2> velocity{};  ///< W [m/s]
  std::array<double, 2> box{};       ///< size of the periodic box [m] > 0

  /// Where the point from X is at time t [m], 0 <= component < box (box itself only by rounding).
  [[nodiscard]] std::array<double, 2> position(const std::array<double, 2>& start, double t) const;
};

/// x - length floor(x/length): a coordinate [m] wrapped into [0, length).
double wrapped(double x, double length);

}  // namespace reference
