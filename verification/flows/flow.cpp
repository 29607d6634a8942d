#include "verification/flows/flow.hpp"

#include <limits>

namespace verification {

std::string name(Location location) {
  return location == Location::Grid ? "grid" : "particles";
}

std::vector<Vec2> Flow::exact_line() const {
  constexpr int intervals = 200;  // smooth to the eye at any figure size
  std::vector<Vec2> points;
  for (int i = 0; i <= intervals; ++i) {
    Vec2 x = probe().point;
    x[across()] = length() * i / intervals;
    points.push_back(x);
  }
  return points;
}

double Flow::steady_probe() const {
  return std::numeric_limits<double>::quiet_NaN();
}

double Flow::pressure_scale() const {
  return std::numeric_limits<double>::quiet_NaN();
}

double Flow::bias_unit(double) const {
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace verification
