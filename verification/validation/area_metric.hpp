#pragma once

#include <vector>

namespace verification {

/// Area between two distribution functions, integral of |F_model - F_data| dx, in the unit of x, and its two
/// sides (ASME V&V 10.1-2012; Ferson, Oberkampf & Ginzburg 2008).
struct Area {
  double above = 0;  ///< where F_model < F_data: the model says more than was measured
  double below = 0;  ///< where F_model > F_data: the model says less
  [[nodiscard]] double total() const { return above + below; }
};

struct Normal {
  double mean = 0, deviation = 0;  ///< deviation >= 0; 0: a value that is known
};

/// Two normal distributions, in closed form. Throws std::invalid_argument for a negative deviation; a NaN
/// gives NaN.
Area area_between(const Normal& model, const Normal& data);

/// A value and the weight with which it occurs.
struct WeightedValue {
  double value = 0, weight = 1;
};

/// Two empirical distributions; weights of each are normalised to a sum of one. Throws std::invalid_argument
/// for an empty one, or a weight that is not positive.
Area area_between(std::vector<WeightedValue> model, std::vector<WeightedValue> data);

}  // namespace verification
