#include "verification/validation/area_metric.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace verification {
namespace {

/// Integral of a normal distribution function from minus infinity to x.
double integrated_distribution(const Normal& normal, double x) {
  if (normal.deviation == 0) return std::max(0.0, x - normal.mean);
  const double z = (x - normal.mean) / normal.deviation;
  return normal.deviation * (z * gsl_cdf_ugaussian_P(z) + gsl_ran_ugaussian_pdf(z));
}

void add(Area& area, double model_minus_data) {
  if (model_minus_data < 0)
    area.above -= model_minus_data;
  else
    area.below += model_minus_data;
}

void normalise(std::vector<WeightedValue>& values) {
  if (values.empty()) throw std::invalid_argument("an empirical distribution needs a value");
  double sum = 0;
  for (const WeightedValue& one : values) {
    if (!(one.weight > 0)) throw std::invalid_argument("the weight of a value must be positive");
    sum += one.weight;
  }
  for (WeightedValue& one : values) one.weight /= sum;
  std::ranges::sort(values, {}, &WeightedValue::value);
}

}  // namespace

Area area_between(const Normal& model, const Normal& data) {
  if (model.deviation < 0 || data.deviation < 0)
    throw std::invalid_argument("a standard deviation cannot be negative");
  const double difference = model.mean - data.mean;
  if (!std::isfinite(difference) || !std::isfinite(model.deviation) || !std::isfinite(data.deviation)) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan};
  }
  Area area;
  if (model.deviation == data.deviation) {
    add(area, -difference);
    return area;
  }
  // Normal distribution functions of unequal width cross once. Left of there the integral of F_model - F_data
  // is that of the two primitives; over the whole line it is the difference of the means.
  const double crossing =
      (model.mean * data.deviation - data.mean * model.deviation) / (data.deviation - model.deviation);
  const double left = integrated_distribution(model, crossing) - integrated_distribution(data, crossing);
  add(area, left);
  add(area, -difference - left);
  return area;
}

Area area_between(std::vector<WeightedValue> model, std::vector<WeightedValue> data) {
  normalise(model);
  normalise(data);
  Area area;
  double below_model = 0, below_data = 0;  // distribution functions up to `x`
  std::size_t m = 0, d = 0;
  double x = std::min(model.front().value, data.front().value);
  while (m < model.size() || d < data.size()) {
    const bool of_model = d == data.size() || (m < model.size() && model[m].value <= data[d].value);
    const WeightedValue& next = of_model ? model[m] : data[d];
    add(area, (below_model - below_data) * (next.value - x));
    (of_model ? below_model : below_data) += next.weight;
    x = next.value;
    ++(of_model ? m : d);
  }
  return area;
}

}  // namespace verification
