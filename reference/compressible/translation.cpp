#include "reference/compressible/translation.hpp"

#include <cmath>

namespace reference {

double wrapped(double x, double length) {
  return x - length * std::floor(x / length);
}

std::array<double, 2> Translation::position(const std::array<double, 2>& start, double t) const {
  return {wrapped(start[0] + velocity[0] * t, box[0]), wrapped(start[1] + velocity[1] * t, box[1])};
}

}  // namespace reference
