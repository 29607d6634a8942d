#include "reference/channel/power_law_exact.hpp"

#include <gsl/gsl_sf_gamma.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reference/gsl_quiet.hpp"
#include "reference/require.hpp"

namespace reference {

BarenblattCouette::BarenblattCouette(double nu_0, double n, double plate_velocity)
    : nu_0_(nu_0), n_(n), plate_velocity_(plate_velocity) {
  require(std::isfinite(nu_0) && nu_0 > 0.0, "Barenblatt: nu_0 must be positive and finite");
  require(std::isfinite(n) && n > 0.0, "Barenblatt: n must be positive and finite");
  require(std::isfinite(plate_velocity) && plate_velocity != 0.0, "Barenblatt: the plate must move");
  quiet_gsl();
  const double area = std::abs(plate_velocity);
  const double half_sqrt_pi = 0.5 * std::sqrt(std::numbers::pi);
  if (n == 1.0) {
    reach_ = 2.0;
    peak_ = area / (2.0 * half_sqrt_pi);
    return;
  }
  // With x = xi/reach the profile is peak (1 -+ x^2)^m; its area fixes reach, in logarithms as powers of k
  // overflow.
  const double m = 1.0 / (n - 1.0), log_k = std::log(std::abs(n - 1.0) / (2.0 * n * (n + 1.0)));
  const double shape_area = half_sqrt_pi * (n > 1.0 ? std::exp(-gsl_sf_lnpoch(m + 1.0, 0.5))
                                                    : std::exp(-gsl_sf_lnpoch(-m - 0.5, 0.5)));
  reach_ = std::exp((std::log(area / shape_area) - m * log_k) / (2.0 * m + 1.0));
  peak_ = area / (reach_ * shape_area);
}

double BarenblattCouette::theta(double t) const {
  return std::pow(nu_0_ * t, 1.0 / (n_ + 1.0));
}

double BarenblattCouette::velocity(double s, double t) const {
  require(s >= 0.0 && t >= 0.0, "Barenblatt: distance and time must not be negative");
  if (s == 0.0) return plate_velocity_;
  if (t == 0.0) return 0.0;
  const double x = s / (theta(t) * reach_);
  if (n_ == 1.0) return plate_velocity_ * std::erfc(x);
  if (n_ > 1.0 && x >= 1.0) return 0.0;
  const double m = 1.0 / (n_ - 1.0);
  gsl_sf_result share{};
  // Near the plate the complement is the small part, and keeps its digits.
  if (n_ > 1.0) {
    if (x > 0.5) {
      gsl_sf_beta_inc_e(m + 1.0, 0.5, (1.0 - x) * (1.0 + x), &share);
      return plate_velocity_ * share.val;
    }
    gsl_sf_beta_inc_e(0.5, m + 1.0, x * x, &share);
  } else {
    if (x > 1.0) {
      gsl_sf_beta_inc_e(-m - 0.5, 0.5, 1.0 / (1.0 + x * x), &share);
      return plate_velocity_ * share.val;
    }
    gsl_sf_beta_inc_e(0.5, -m - 0.5, x * x / (1.0 + x * x), &share);
  }
  return plate_velocity_ * (1.0 - share.val);
}

double BarenblattCouette::rate(double s, double t) const {
  require(s >= 0.0 && t > 0.0, "Barenblatt: the distance must not be negative, the time must be positive");
  const double x = s / (theta(t) * reach_), peak = std::copysign(peak_, plate_velocity_) / theta(t);
  if (n_ == 1.0) return peak * std::exp(-x * x);
  if (n_ > 1.0 && x >= 1.0) return 0.0;
  const double log_base = n_ > 1.0 ? std::log1p(-x) + std::log1p(x) : std::log1p(x * x);
  return peak * std::exp(log_base / (n_ - 1.0));
}

double BarenblattCouette::thickness(double t) const {
  return theta(t) * std::abs(plate_velocity_) / peak_;
}

double BarenblattCouette::time_of_thickness(double thickness) const {
  return std::pow(thickness * peak_ / std::abs(plate_velocity_), n_ + 1.0) / nu_0_;
}

double BarenblattCouette::arrival(double s) const {
  if (n_ <= 1.0) return std::numeric_limits<double>::infinity();
  return std::pow(s / reach_, n_ + 1.0) / nu_0_;
}

PowerLawStartUp::PowerLawStartUp(double nu_0, double n, double body_acceleration)
    : nu_0_(nu_0), n_(n), body_acceleration_(body_acceleration) {
  require(std::isfinite(nu_0) && nu_0 > 0.0, "power-law start-up: nu_0 must be positive and finite");
  require(std::isfinite(n) && n >= kLeastExponent, "power-law start-up: n must be at least 1.05");
  require(std::isfinite(body_acceleration) && body_acceleration != 0.0,
          "power-law start-up: the body acceleration must not be zero");
  // The equation is homogeneous (f ~ eta^((n+1)/(n-1))), so the profile with its front at 1 gives all. With p
  // = -f', v = p^(n-1) and R = f/p are analytic in d = 1 - eta and obey
  //   n/(n-1) v' = R + n/(n+1) (1 - d),  (n-1) v R' = (n-1) v - R v',  v = R = 0 at d = 0:
  // a recurrence for their power series, which converges beyond the wall at d = 1.
  v_ = {0.0, (n - 1.0) / (n + 1.0)};
  r_ = {0.0, (n - 1.0) / n};
  for (int k = 2; std::max(std::abs(v_.back()), std::abs(r_.back())) > 1e-18 && k < 2000; ++k) {
    v_.push_back((n - 1.0) / (n * k) * (r_[k - 1] - (k == 2 ? n / (n + 1.0) : 0.0)));
    double sum = r_[1] * k * v_[k];
    for (int i = 2; i <= k; ++i) {
      const int j = k + 1 - i;
      sum += (n - 1.0) * v_[i] * j * r_[j] + (i < k ? r_[i] * j * v_[j] : 0.0);
    }
    r_.push_back(((n - 1.0) * v_[k] - sum) / (v_[1] * ((n - 1.0) * k + 1.0)));
  }
  front_ = slope_scale_ = 1.0;
  const double wall = profile(0.0).value;  // must become 1
  front_ = std::pow(wall, -(n - 1.0) / (n + 1.0));
  slope_scale_ = 1.0 / (wall * front_);
}

double PowerLawStartUp::length(double t) const {
  return std::pow(nu_0_ * std::pow(std::abs(body_acceleration_), n_ - 1.0) * std::pow(t, n_),
                  1.0 / (n_ + 1.0));
}

PowerLawStartUp::Profile PowerLawStartUp::profile(double eta) const {
  const double d = 1.0 - eta / front_;
  if (d <= 0.0) return {0.0, 0.0};
  double v = 0.0, r = 0.0;
  for (std::size_t k = v_.size() - 1; k > 0; --k) v = (v + v_[k]) * d;
  for (std::size_t k = r_.size() - 1; k > 0; --k) r = (r + r_[k]) * d;
  const double slope = slope_scale_ * std::pow(v, 1.0 / (n_ - 1.0));
  return {slope, front_ * r * slope};
}

double PowerLawStartUp::velocity(double s, double t) const {
  require(s >= 0.0 && t >= 0.0, "power-law start-up: distance and time must not be negative");
  if (s == 0.0 || t == 0.0) return 0.0;
  return body_acceleration_ * t * (1.0 - profile(s / length(t)).value);
}

double PowerLawStartUp::gradient(double s, double t) const {
  require(s >= 0.0 && t >= 0.0, "power-law start-up: distance and time must not be negative");
  if (t == 0.0) return 0.0;
  const double l = length(t);
  return body_acceleration_ * t / l * profile(s / l).slope;
}

double PowerLawStartUp::arrival(double s) const {
  return std::pow(std::pow(s / front_, n_ + 1.0) / (nu_0_ * std::pow(std::abs(body_acceleration_), n_ - 1.0)),
                  1.0 / n_);
}

}  // namespace reference
