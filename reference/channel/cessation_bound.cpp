#include "reference/channel/cessation_bound.hpp"

#include <cmath>
#include <numbers>

#include "reference/require.hpp"

namespace reference {

CessationBound::CessationBound(double height, const HerschelBulkleyCurve& curve) {
  curve.check();
  require(std::isfinite(height) && height > 0.0, "cessation: the height must be positive and finite");
  constexpr double pi = std::numbers::pi;
  a_ = curve.n == 1.0 ? curve.nu_0 * pi * pi / (height * height) : 0.0;
  b_ = 2.0 * curve.tau_y / height;
  c_ = curve.tau_y / (std::numbers::e * curve.m);
  rest_ = 2.0 * c_ / (b_ + std::sqrt(b_ * b_ + 4.0 * a_ * c_));
}

double CessationBound::stopping_time(double u_0) const {
  return a_ > 0.0 ? std::log1p(a_ * u_0 / b_) / a_ : u_0 / b_;
}

double CessationBound::time_between(double u_0, double u) const {
  // Integral of s/(a s^2 + b s - c) = s/((s - rest)(a s + a rest + b)), by partial fractions.
  const double other = b_ + a_ * rest_;  // a s + other vanishes at the other root
  const double at_rest = rest_ * std::log((u_0 - rest_) / (u - rest_)) / (other + a_ * rest_);
  const double far = a_ > 0.0 ? other / a_ * std::log1p(a_ * (u_0 - u) / (a_ * u + other)) : u_0 - u;
  return at_rest + far / (other + a_ * rest_);
}

double CessationBound::speed(double u_0, double t) const {
  require(t >= 0.0, "cessation: the time must not be negative");
  if (u_0 <= rest_) return rest_;
  double low = rest_, high = u_0;
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return high;
    (time_between(u_0, middle) > t ? low : high) = middle;
  }
}

}  // namespace reference
