#include "verification/convergence/order.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "verification/convergence/root.hpp"
#include "verification/not_a_number.hpp"

namespace verification {

namespace {

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

void require(bool condition, std::string_view caller, const char* message) {
  if (!condition) throw std::invalid_argument(std::string(caller) + ": " + message);
}

Convergence classify_triplet(double e21, double e32, double monotone_limit, double floor) {
  if (std::abs(e21) <= floor) return Convergence::Floor;
  const double ratio = e21 / e32;  // +-inf for e32 == 0: divergent below
  if (ratio > 0.0 && ratio < monotone_limit) return Convergence::Monotone;
  if (ratio < 0.0 && ratio > -1.0) return Convergence::Oscillatory;
  return Convergence::Divergent;
}

int severity(Convergence c) {
  switch (c) {
    case Convergence::Monotone:
      return 0;
    case Convergence::Oscillatory:
      return 1;
    case Convergence::Floor:
      return 2;
    case Convergence::Divergent:
      return 3;
    case Convergence::Invalid:
      return 4;
  }
  return 4;
}

/// `limit(k)`: the bound on R for the triplet whose coarse grid is level k.
template <class Limit>
Convergence classify_triplets(const std::vector<double>& values, double floor, Limit limit) {
  constexpr std::string_view caller = "classify_functional";
  require(values.size() >= 3, caller, "at least three grids are needed");
  require(floor >= 0.0 && std::isfinite(floor), caller, "the floor must be finite and not negative");
  if (!all_finite(values)) return Convergence::Invalid;
  Convergence worst = Convergence::Monotone;
  for (std::size_t k = 0; k + 2 < values.size(); ++k) {
    const double e32 = values[k] - values[k + 1];
    const double e21 = values[k + 1] - values[k + 2];
    const Convergence c = classify_triplet(e21, e32, limit(k), floor);
    if (severity(c) > severity(worst)) worst = c;
  }
  return worst;
}

void check_options(const OrderOptions& options, std::string_view caller) {
  require(options.floor >= 0.0 && std::isfinite(options.floor), caller,
          "the floor must be finite and not negative");
  require(options.floor_factor >= 1.0 && std::isfinite(options.floor_factor), caller,
          "the floor factor must be finite and at least 1");
  require(options.confidence > 0.0 && options.confidence < 1.0, caller,
          "the confidence must lie between 0 and 1");
}

void check_errors(const std::vector<double>& errors, std::string_view caller) {
  require(std::none_of(errors.begin(), errors.end(), [](double e) { return e < 0.0; }), caller,
          "errors must not be negative");
}

double mean(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

double centred_dot(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean(a);
  const double mean_b = mean(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
  return sum;
}

/// An estimate with flags set, levels at the floor dropped, and nothing fitted yet.
OrderEstimate drop_floor(const std::vector<double>& errors, const OrderOptions& options) {
  OrderEstimate estimate{Convergence::Invalid, nan, nan, nan, false, nan, {}, {}, 0};
  estimate.used.assign(errors.size(), false);
  if (!all_finite(errors)) return estimate;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    estimate.used[i] = errors[i] > options.floor_factor * options.floor;
    if (estimate.used[i]) ++estimate.used_count;
  }
  if (estimate.used_count < 2) estimate.convergence = Convergence::Floor;
  return estimate;
}

bool needs_fit(const OrderEstimate& estimate) {
  return estimate.used_count >= 2;
}

std::vector<double> select(const std::vector<double>& values, const std::vector<bool>& used) {
  std::vector<double> selected;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (used[i]) selected.push_back(values[i]);
  }
  return selected;
}

std::vector<double> logarithms(const std::vector<double>& values) {
  std::vector<double> logs(values.size());
  std::transform(values.begin(), values.end(), logs.begin(), [](double v) { return std::log(v); });
  return logs;
}

/// Interval of a slope: `sensitivity` is d(model)/d(order) at each used level, `residual` data minus model.
void set_interval(OrderEstimate& estimate, const std::vector<double>& sensitivity,
                  const std::vector<double>& residual, double confidence) {
  if (estimate.used_count < 3) return;
  const double dof = static_cast<double>(estimate.used_count) - 2.0;
  const double sum_of_squares = std::inner_product(residual.begin(), residual.end(), residual.begin(), 0.0);
  const double standard_error = std::sqrt(sum_of_squares / dof / centred_dot(sensitivity, sensitivity));
  const double half_width = gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, dof) * standard_error;
  estimate.lower = estimate.order - half_width;
  estimate.upper = estimate.order + half_width;
  estimate.has_interval = true;
}

/// ln|a^p - b^p| - ln|p| of a > b > 0. The common ln|p| belongs to the coefficient; without it the function
/// is smooth through p = 0, where it is ln ln(a/b).
double log_power_difference(double log_a, double log_b, double p) {
  const double gap = log_a - log_b;
  const double t = p * gap;
  if (std::abs(t) < 1e-8) return p * log_b + std::log(gap) + 0.5 * t;
  if (t > 30.0) return p * log_a + std::log1p(-std::exp(-t)) - std::log(p);
  return p * log_b + std::log(std::expm1(t) / p);
}

/// Derivative of log_power_difference with respect to p.
double log_power_difference_slope(double log_a, double log_b, double p) {
  const double gap = log_a - log_b;
  const double t = p * gap;
  // t/(1 - e^-t) - 1 over p; its series removes the cancellation near p = 0.
  if (std::abs(t) < 1e-3) return log_b + gap * (0.5 + t / 12.0);
  return log_b + gap / -std::expm1(-t) - 1.0 / p;
}

}  // namespace

std::string_view to_string(Convergence convergence) {
  switch (convergence) {
    case Convergence::Monotone:
      return "monotone";
    case Convergence::Oscillatory:
      return "oscillatory";
    case Convergence::Divergent:
      return "divergent";
    case Convergence::Floor:
      return "floor";
    case Convergence::Invalid:
      return "invalid";
  }
  return "invalid";
}

void check_ladder(const std::vector<double>& steps, std::size_t minimum, std::string_view caller) {
  if (steps.size() < minimum) {
    throw std::invalid_argument(std::string(caller) + ": at least " + std::to_string(minimum) +
                                " levels are needed, got " + std::to_string(steps.size()));
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    require(std::isfinite(steps[i]) && steps[i] > 0.0, caller, "steps must be positive and finite");
    require(i == 0 || steps[i] < steps[i - 1], caller, "steps must decrease strictly, coarse to fine");
  }
}

Convergence classify_functional(const std::vector<double>& values, double floor) {
  return classify_triplets(values, floor, [](std::size_t) { return 1.0; });
}

Convergence classify_functional(const std::vector<double>& steps, const std::vector<double>& values,
                                double floor) {
  constexpr std::string_view caller = "classify_functional";
  check_ladder(steps, 3, caller);
  require(values.size() == steps.size(), caller, "one value a step is needed");
  return classify_triplets(values, floor, [&](std::size_t k) {
    return std::log(steps[k + 1] / steps[k + 2]) / std::log(steps[k] / steps[k + 1]);
  });
}

Convergence classify_errors(const std::vector<double>& errors) {
  check_errors(errors, "classify_errors");
  if (!all_finite(errors)) return Convergence::Invalid;
  if (std::count_if(errors.begin(), errors.end(), [](double e) { return e > 0.0; }) < 2) {
    return Convergence::Floor;
  }
  for (std::size_t i = 1; i < errors.size(); ++i) {
    if (!(errors[i] < errors[i - 1])) return Convergence::Divergent;
  }
  return Convergence::Monotone;
}

OrderEstimate estimate_order(const std::vector<double>& steps, const std::vector<double>& errors,
                             const OrderOptions& options) {
  constexpr std::string_view caller = "estimate_order";
  check_ladder(steps, 2, caller);
  require(errors.size() == steps.size(), caller, "one error a step is needed");
  check_errors(errors, caller);
  check_options(options, caller);

  OrderEstimate estimate = drop_floor(errors, options);
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const bool defined =
        std::isfinite(errors[i]) && std::isfinite(errors[i + 1]) && errors[i] > 0.0 && errors[i + 1] > 0.0;
    estimate.pairwise.push_back(
        defined ? (std::log(errors[i]) - std::log(errors[i + 1])) / std::log(steps[i] / steps[i + 1]) : nan);
  }
  if (!needs_fit(estimate)) return estimate;

  const std::vector<double> kept = select(errors, estimate.used);
  estimate.convergence = classify_errors(kept);
  const std::vector<double> x = logarithms(select(steps, estimate.used));
  const std::vector<double> y = logarithms(kept);
  estimate.order = centred_dot(x, y) / centred_dot(x, x);
  estimate.log_coefficient = mean(y) - estimate.order * mean(x);
  std::vector<double> residual(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    residual[i] = (y[i] - mean(y)) - estimate.order * (x[i] - mean(x));
  }
  set_interval(estimate, x, residual, options.confidence);
  return estimate;
}

std::vector<double> successive_steps(const std::vector<double>& steps) {
  check_ladder(steps, 2, "successive_steps");
  return {steps.begin(), steps.end() - 1};
}

OrderEstimate estimate_order_from_differences(const std::vector<double>& steps,
                                              const std::vector<double>& differences,
                                              const OrderOptions& options) {
  constexpr std::string_view caller = "estimate_order_from_differences";
  check_ladder(steps, 3, caller);
  require(differences.size() + 1 == steps.size(), caller, "one difference a neighbouring pair is needed");
  check_errors(differences, caller);
  check_options(options, caller);

  OrderEstimate estimate = drop_floor(differences, options);
  for (std::size_t i = 0; i + 1 < differences.size(); ++i) {
    const double ratio = differences[i] / differences[i + 1];
    const bool defined = std::isfinite(ratio) && ratio > 0.0;
    estimate.pairwise.push_back(
        defined ? three_grid_order(steps[i + 1] / steps[i + 2], steps[i] / steps[i + 1], ratio, 1) : nan);
  }
  if (!needs_fit(estimate)) return estimate;

  const std::vector<double> log_steps = logarithms(steps);
  const std::vector<double> coarse = select({log_steps.begin(), log_steps.end() - 1}, estimate.used);
  const std::vector<double> fine = select({log_steps.begin() + 1, log_steps.end()}, estimate.used);
  const std::vector<double> y = logarithms(select(differences, estimate.used));
  const std::size_t n = y.size();
  std::vector<double> residual(n);
  std::vector<double> sensitivity(n);
  const auto evaluate = [&](double p) {
    for (std::size_t i = 0; i < n; ++i) {
      residual[i] = y[i] - log_power_difference(coarse[i], fine[i], p);
      sensitivity[i] = log_power_difference_slope(coarse[i], fine[i], p);
    }
  };
  // The normal equation in p; the coefficient is eliminated by centring.
  estimate.order = find_root(
      [&](double p) {
        evaluate(p);
        return centred_dot(residual, sensitivity);
      },
      centred_dot(coarse, y) / centred_dot(coarse, coarse), 0.5);
  if (!std::isfinite(estimate.order)) return estimate;

  evaluate(estimate.order);
  const double offset = mean(residual);
  for (double& r : residual) r -= offset;
  estimate.log_coefficient = offset - std::log(std::abs(estimate.order));
  set_interval(estimate, sensitivity, residual, options.confidence);

  estimate.convergence = Convergence::Monotone;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    // p > 0 of a pair, said without solving for it: the difference shrinks faster than at p = 0.
    const double at_zero =
        log_power_difference(coarse[i + 1], fine[i + 1], 0.0) - log_power_difference(coarse[i], fine[i], 0.0);
    if (!(y[i + 1] - y[i] < at_zero)) estimate.convergence = Convergence::Divergent;
  }
  return estimate;
}

double three_grid_order(double r21, double r32, double difference_ratio, int sign) {
  constexpr std::string_view caller = "three_grid_order";
  require(r21 > 1.0 && r32 > 1.0 && std::isfinite(r21) && std::isfinite(r32), caller,
          "refinement ratios must be finite and greater than 1");
  require(difference_ratio > 0.0 && std::isfinite(difference_ratio), caller,
          "the ratio of the differences must be positive and finite");
  require(sign == 1 || sign == -1, caller, "the sign must be +1 or -1");
  const double log_r21 = std::log(r21);
  const double log_r32 = std::log(r32);
  const double target = std::log(difference_ratio);
  const auto mismatch = [&](double p) {
    if (sign > 0) {
      // Medium and coarse step are r21 and r21 r32 times the fine one.
      return log_power_difference(log_r21 + log_r32, log_r21, p) - log_power_difference(log_r21, 0.0, p) -
             target;
    }
    const auto softplus = [](double t) {
      return t > 0.0 ? t + std::log1p(std::exp(-t)) : std::log1p(std::exp(t));
    };
    return p * log_r21 + softplus(p * log_r32) - softplus(p * log_r21) - target;
  };
  return find_root(mismatch, target / log_r32, 0.5);
}

}  // namespace verification
