#pragma once

#include <Eigen/Core>
#include <vector>

namespace verification {

/// Relative error norms of one sample, all dimensionless.
struct Norms {
  double l1 = 0.0;    ///< mean |e| / scale
  double l2 = 0.0;    ///< sqrt(mean e^2) / scale
  double linf = 0.0;  ///< max |e| / scale
};

/// Norms of an error sample, relative to `scale` (> 0, the unit of the errors, e.g. V_max in m/s).
///
/// `errors`: one entry a sample point; the sign does not matter.
/// `weights`: empty for equal weights, else one entry a sample point, >= 0 with a positive sum; they are
/// normalised to sum 1. A point of zero weight does not take part in any norm, linf included.
/// A NaN or an infinity in any entry, whatever its weight, makes all three norms NaN: a diverged run never
/// passes for an accurate one.
/// Throws std::invalid_argument for an empty sample, a scale that is not positive and finite, or bad weights.
Norms error_norms(const std::vector<double>& errors, double scale, const std::vector<double>& weights = {});

/// The same for vector errors; |e| is the Euclidean length.
Norms error_norms(const std::vector<Eigen::Vector2d>& errors, double scale,
                  const std::vector<double>& weights = {});

}  // namespace verification
