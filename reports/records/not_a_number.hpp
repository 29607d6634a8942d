#pragma once

#include <limits>

namespace reports {

/// What stands for a number that nobody measured; it passes no check.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace reports
