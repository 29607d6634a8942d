#include "verification/validation/latin_hypercube.hpp"

#include <gsl/gsl_cdf.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>

namespace verification {
namespace {

/// In (0, 1), 52 bits. The distributions of the standard library differ from one library to the next.
double uniform(std::mt19937_64& random) {
  return (static_cast<double>(random() >> 12) + 0.5) * 0x1p-52;
}

}  // namespace

double InputDistribution::quantile(double p) const {
  switch (shape) {
    case Shape::Normal:
      return value + uncertainty * gsl_cdf_ugaussian_Pinv(p);
    case Shape::LogNormal:
      return value * std::exp(uncertainty / value * gsl_cdf_ugaussian_Pinv(p));
    default:
      return value + uncertainty * std::numbers::sqrt3 * (2 * p - 1);
  }
}

InputDistribution::Shape shape_named(const std::string& text) {
  if (text == "normal") return InputDistribution::Shape::Normal;
  if (text == "uniform") return InputDistribution::Shape::Uniform;
  if (text == "log-normal") return InputDistribution::Shape::LogNormal;
  throw std::invalid_argument("must be \"normal\", \"uniform\" or \"log-normal\"");
}

std::vector<std::vector<double>> latin_hypercube(const std::vector<InputDistribution>& inputs, int count,
                                                 std::uint64_t seed) {
  if (count < 2 || inputs.empty())
    throw std::invalid_argument("a Latin hypercube needs an input and at least two samples");
  std::mt19937_64 random(seed);
  const auto n = static_cast<std::size_t>(count);
  std::vector<std::vector<double>> samples(n);
  std::vector<std::size_t> order(n);
  for (const InputDistribution& input : inputs) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = n; i-- > 1;)
      std::swap(order[i], order[static_cast<std::size_t>(uniform(random) * static_cast<double>(i + 1))]);
    for (std::size_t i = 0; i < n; ++i)
      samples[i].push_back(
          input.quantile((static_cast<double>(order[i]) + uniform(random)) / static_cast<double>(n)));
  }
  return samples;
}

SampleMoments moments(const std::vector<double>& samples) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (samples.size() < 2) return {nan, nan};
  const auto n = static_cast<double>(samples.size());
  SampleMoments result;
  for (const double x : samples) result.mean += x / n;
  for (const double x : samples) result.deviation += (x - result.mean) * (x - result.mean) / (n - 1);
  result.deviation = std::sqrt(result.deviation);
  return result;
}

}  // namespace verification
