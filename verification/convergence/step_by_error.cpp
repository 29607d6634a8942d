#include "verification/convergence/step_by_error.hpp"

#include <algorithm>
#include <cmath>

#include "verification/not_a_number.hpp"

namespace verification {
namespace {

// (end - begin)/dt is a whole number but for rounding.
constexpr double sliver = 1e-9;
constexpr double finest_common = 20;  // shortest interval over the common one, at most

}  // namespace

double PowerLaw::at(double step) const {
  return coefficient * std::pow(step, order);
}

double PowerLaw::inverse(double value) const {
  return std::pow(value / coefficient, 1 / order);
}

TimeError time_error_of(double dt, double first, double second, double formal_order, double round_off) {
  TimeError error;
  error.observed_order = nan;
  if (!std::isfinite(first) || !std::isfinite(second)) return error;
  if (first <= round_off && second <= round_off) {
    error.kind = TimeError::Kind::RoundOff;
    return error;
  }
  error.observed_order = std::log2(first / second);
  if (!(error.observed_order >= 0.5 * formal_order)) return error;
  error.kind = TimeError::Kind::Law;
  error.law.order = std::min(error.observed_order, formal_order);
  error.law.coefficient = first / (std::pow(dt, error.law.order) * (1 - std::pow(2.0, -error.law.order)));
  return error;
}

PowerLaw space_error_of(double coarse, double coarse_error, double fine, double fine_error,
                        double theoretical) {
  PowerLaw law;
  law.order = std::log(coarse_error / fine_error) / std::log(coarse / fine);
  if (theoretical > law.order || !std::isfinite(law.order)) law.order = theoretical;
  law.coefficient = fine_error / std::pow(fine, law.order);
  return law;
}

const char* name(StepBound bound) {
  static const char* const names[] = {"error", "stability", "outputs", "pilot", "none"};
  return names[static_cast<int>(bound)];
}

ChosenStep step_by_error(const PowerLaw& time, double target, double stable, double tried, double interval) {
  const double accurate = time.inverse(target);
  ChosenStep chosen = step_by_bounds(stable, tried, interval);
  if (!(accurate > 0)) return {0, StepBound::None};
  if (accurate < chosen.dt) chosen = {interval / std::ceil(interval / accurate - sliver), StepBound::Error};
  return chosen;
}

ChosenStep step_by_bounds(double stable, double tried, double interval) {
  ChosenStep chosen{interval, StepBound::Outputs};
  if (tried < chosen.dt) chosen = {tried, StepBound::Pilot};
  if (stable <= chosen.dt) chosen = {stable, StepBound::Stability};
  chosen.dt = interval / std::ceil(interval / chosen.dt - sliver);
  return chosen;
}

double common_interval(double begin, const std::vector<double>& outputs) {
  std::vector<double> intervals;
  for (const double end : outputs) {
    intervals.push_back(end - begin);
    begin = end;
  }
  const double shortest = *std::ranges::min_element(intervals);
  double common = shortest;
  for (const double interval : intervals) {  // Euclid's algorithm
    double a = interval, b = common;
    while (b > sliver * shortest * finest_common) {
      const double rest = std::abs(a - b * std::round(a / b));
      a = b;
      b = rest;
    }
    common = a;
  }
  return common * finest_common < shortest ? shortest : common;
}

}  // namespace verification
