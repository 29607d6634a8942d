#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace verification {

/// How an uncertain input is distributed about its nominal value.
struct InputDistribution {
  enum class Shape { Normal, Uniform, LogNormal };
  Shape shape = Shape::Normal;
  double value = 0;        ///< nominal: the mean, or the median of a log-normal one
  double uncertainty = 0;  ///< standard deviation > 0; of a log-normal one that of ln(X/value) times value

  /// Value below which X lies with probability p in (0, 1).
  [[nodiscard]] double quantile(double p) const;
};
/// "normal", "uniform", "log-normal"; throws std::invalid_argument for another.
InputDistribution::Shape shape_named(const std::string& text);

/// `count` samples of independent inputs, one row each: every input has one value in each of `count` equally
/// likely intervals, in an order of its own (McKay, Beckman & Conover 1979). The same seed gives the same
/// bits with every standard library. Throws std::invalid_argument for fewer than two samples or no input.
std::vector<std::vector<double>> latin_hypercube(const std::vector<InputDistribution>& inputs, int count,
                                                 std::uint64_t seed);

/// Mean and standard deviation (n - 1) of samples; NaN for fewer than two.
struct SampleMoments {
  double mean = 0, deviation = 0;
};
SampleMoments moments(const std::vector<double>& samples);

}  // namespace verification
