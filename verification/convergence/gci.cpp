#include "verification/convergence/gci.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "verification/not_a_number.hpp"

namespace verification {

namespace {

/// |difference / value|, NaN for a value of zero.
double relative(double difference, double value) {
  return value == 0.0 ? nan : std::abs(difference / value);
}

bool converges(Convergence c) {
  return c == Convergence::Monotone || c == Convergence::Oscillatory;
}

/// Order of a triplet (fine 1, medium 2, coarse 3); NaN if a difference is zero or not finite.
double triplet_order(double r21, double r32, double e21, double e32) {
  const double ratio = e32 / e21;
  if (!std::isfinite(ratio) || ratio == 0.0) return nan;
  return three_grid_order(r21, r32, std::abs(ratio), ratio > 0.0 ? 1 : -1);
}

}  // namespace

GciResult grid_convergence_index(const std::vector<double>& steps, const std::vector<double>& values,
                                 double formal_order, SafetyRule rule) {
  check_ladder(steps, 3, "grid_convergence_index");
  if (steps.size() != 3 || values.size() != 3) {
    throw std::invalid_argument("grid_convergence_index: exactly three steps and three values are needed");
  }
  if (!(formal_order > 0.0) || !std::isfinite(formal_order)) {
    throw std::invalid_argument("grid_convergence_index: the formal order must be positive and finite");
  }
  const double r21 = steps[1] / steps[2];
  const double r32 = steps[0] / steps[1];
  const double phi1 = values[2];
  const double phi2 = values[1];
  const double e21 = phi2 - phi1;
  const double e32 = values[0] - phi2;

  GciResult result;
  result.convergence = classify_functional(steps, values);
  result.ratio = e21 / e32;
  result.observed_order = triplet_order(r21, r32, e21, e32);
  if (!converges(result.convergence)) {
    result.used_order = result.safety_factor = result.extrapolated = nan;
    result.relative_error = result.extrapolated_error = nan;
    result.gci_fine = result.gci_coarse = nan;
    result.uncertainty = result.uncertainty_coarse = result.asymptotic_ratio = nan;
    return result;
  }

  const double p = result.observed_order;
  if (rule == SafetyRule::Celik2008) {
    result.safety_factor = 1.25;
    result.used_order = p;
  } else if (result.convergence == Convergence::Monotone &&
             std::abs(p - formal_order) <= 0.1 * formal_order) {
    result.safety_factor = 1.25;
    result.used_order = formal_order;
  } else {
    result.safety_factor = 3.0;
    result.used_order = std::min(std::max(0.5, p), formal_order);
  }

  // expm1 keeps r^p - 1 accurate for small p or ratios close to 1.
  const double correction = e21 / std::expm1(p * std::log(r21));
  result.extrapolated = phi1 - correction;
  result.relative_error = relative(e21, phi1);
  result.extrapolated_error = relative(correction, result.extrapolated);
  const double used_gain21 = std::expm1(result.used_order * std::log(r21));
  const double used_gain32 = std::expm1(result.used_order * std::log(r32));
  result.uncertainty = result.safety_factor * std::abs(e21) / used_gain21;
  result.uncertainty_coarse = result.safety_factor * std::abs(e32) / used_gain32;
  result.gci_fine = relative(result.uncertainty, phi1);
  result.gci_coarse = relative(result.uncertainty_coarse, phi2);
  result.asymptotic_ratio = result.gci_coarse / (std::pow(r21, result.used_order) * result.gci_fine);
  return result;
}

OrderSequence observed_orders(const std::vector<double>& steps, const std::vector<double>& values) {
  check_ladder(steps, 4, "observed_orders");
  if (values.size() != steps.size()) {
    throw std::invalid_argument("observed_orders: one value a step is needed");
  }
  OrderSequence sequence{{}, 0.0};
  for (std::size_t k = 0; k + 2 < steps.size(); ++k) {
    const Convergence c = classify_functional({steps[k], steps[k + 1], steps[k + 2]},
                                              {values[k], values[k + 1], values[k + 2]});
    sequence.orders.push_back(converges(c)
                                  ? triplet_order(steps[k + 1] / steps[k + 2], steps[k] / steps[k + 1],
                                                  values[k + 1] - values[k + 2], values[k] - values[k + 1])
                                  : nan);
  }
  for (std::size_t k = 1; k < sequence.orders.size(); ++k) {
    const double step = std::abs(sequence.orders[k] - sequence.orders[k - 1]);
    // Written so that a NaN, once met, stays.
    if (!(step <= sequence.drift) && !std::isnan(sequence.drift)) sequence.drift = step;
  }
  sequence.drift /= std::abs(sequence.orders.back());
  return sequence;
}

}  // namespace verification
