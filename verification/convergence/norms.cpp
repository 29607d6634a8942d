#include "verification/convergence/norms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace verification {

namespace {

void check_weights(const std::vector<double>& weights, std::size_t size) {
  if (weights.empty()) return;
  if (weights.size() != size) throw std::invalid_argument("error_norms: one weight an error is needed");
  double sum = 0.0;
  for (double w : weights) {
    if (!(w >= 0.0) || !std::isfinite(w)) {
      throw std::invalid_argument("error_norms: weights must be finite and not negative");
    }
    sum += w;
  }
  if (!(sum > 0.0) || !std::isfinite(sum)) {
    throw std::invalid_argument("error_norms: the weights must have a positive, finite sum");
  }
}

Norms norms_of_magnitudes(const std::vector<double>& magnitudes, double scale,
                          const std::vector<double>& weights) {
  if (magnitudes.empty()) throw std::invalid_argument("error_norms: the sample is empty");
  if (!(scale > 0.0) || !std::isfinite(scale)) {
    throw std::invalid_argument("error_norms: the scale must be positive and finite");
  }
  check_weights(weights, magnitudes.size());

  for (double e : magnitudes) {
    if (!std::isfinite(e)) {
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      return {nan, nan, nan};
    }
  }
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };

  double largest = 0.0;
  for (std::size_t i = 0; i < magnitudes.size(); ++i) {
    if (weight(i) > 0.0) largest = std::max(largest, magnitudes[i]);
  }
  if (largest == 0.0) return {};

  // Dividing by the largest magnitude first keeps the squares from overflow and underflow.
  double weight_sum = 0.0;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (std::size_t i = 0; i < magnitudes.size(); ++i) {
    if (weight(i) == 0.0) continue;
    const double e = magnitudes[i] / largest;
    weight_sum += weight(i);
    sum += weight(i) * e;
    sum_of_squares += weight(i) * e * e;
  }
  const double linf = largest / scale;
  return {linf * (sum / weight_sum), linf * std::sqrt(sum_of_squares / weight_sum), linf};
}

}  // namespace

Norms error_norms(const std::vector<double>& errors, double scale, const std::vector<double>& weights) {
  std::vector<double> magnitudes(errors.size());
  std::transform(errors.begin(), errors.end(), magnitudes.begin(), [](double e) { return std::abs(e); });
  return norms_of_magnitudes(magnitudes, scale, weights);
}

Norms error_norms(const std::vector<Eigen::Vector2d>& errors, double scale,
                  const std::vector<double>& weights) {
  std::vector<double> magnitudes(errors.size());
  std::transform(errors.begin(), errors.end(), magnitudes.begin(), [](const Eigen::Vector2d& e) {
    // hypot(inf, NaN) is inf, which the caller turns into NaN as well.
    return std::hypot(e.x(), e.y());
  });
  return norms_of_magnitudes(magnitudes, scale, weights);
}

}  // namespace verification
