#include "verification/validation/bias_scatter.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace verification {

BiasScatter bias_and_scatter(const std::vector<CasePair>& pairs, double relative_data_uncertainty) {
  if (relative_data_uncertainty < 0) throw std::invalid_argument("a relative uncertainty cannot be negative");
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<double>(pairs.size());
  std::vector<double> ratios;
  double mean = 0;
  for (const CasePair& pair : pairs) {
    if (!(pair.computed > 0 && pair.measured > 0)) return {nan, nan, nan};
    ratios.push_back(std::log(pair.computed / pair.measured));
    mean += ratios.back() / n;
  }
  if (pairs.size() < 2 || !std::isfinite(mean)) return {nan, nan, nan};
  double variance = 0;
  for (const double r : ratios) variance += (r - mean) * (r - mean) / (n - 1);
  const double sigma_e = std::min(relative_data_uncertainty, std::sqrt(0.5 * variance));
  const double sigma_m = std::sqrt(std::max(0.0, variance - sigma_e * sigma_e));
  return {std::exp(mean + 0.5 * (sigma_m * sigma_m - sigma_e * sigma_e)), sigma_m, sigma_e};
}

double exceedance_probability(double computed, double critical, const BiasScatter& model) {
  const double mean = computed / model.bias;
  return gsl_cdf_gaussian_Q(critical - mean, model.scatter * std::abs(mean));
}

}  // namespace verification
