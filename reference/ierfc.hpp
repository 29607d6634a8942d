#pragma once

#include <cmath>
#include <numbers>

namespace reference {

/// First repeated integral of erfc from x to infinity (Abramowitz & Stegun 7.2.1).
inline double ierfc(double x) {
  return std::exp(-x * x) / std::sqrt(std::numbers::pi) - x * std::erfc(x);
}

}  // namespace reference
