#include "reference/channel/traction/stress_driven_channel.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "reference/ierfc.hpp"
#include "reference/require.hpp"

namespace reference {
namespace {

using std::numbers::pi;

constexpr double negligible = 1e-18;

}  // namespace

StressDrivenChannel::StressDrivenChannel(double height, double kinematic_viscosity,
                                         double stress_over_density)
    : height_(height), nu_(kinematic_viscosity), rate_(stress_over_density / kinematic_viscosity) {
  require(std::isfinite(height) && height > 0, "channel: the height must be positive and finite");
  require(std::isfinite(nu_) && nu_ > 0, "channel: the kinematic viscosity must be positive and finite");
  require(std::isfinite(rate_) && rate_ != 0, "channel: the stress must be finite and not zero");
}

double StressDrivenChannel::by_modes(double y, double t) const {
  double sum = 0;
  for (int n = 0;; ++n) {
    const double l = (n + 0.5) * pi / height_, decay = std::exp(-nu_ * l * l * t);
    if (decay < negligible) break;
    sum += (n % 2 == 0 ? 1 : -1) * std::sin(l * y) * decay / (l * l);
  }
  return rate_ * (y - 2 / height_ * sum);
}

double StressDrivenChannel::by_images(double y, double t) const {
  const double d = 2 * std::sqrt(nu_ * t);
  double sum = 0;
  for (int k = 0;; ++k) {
    const double near = ierfc(((2 * k + 1) * height_ - y) / d);
    if (k > 0 && near < negligible) break;
    sum += (k % 2 == 0 ? 1 : -1) * (near - ierfc(((2 * k + 1) * height_ + y) / d));
  }
  return rate_ * d * sum;
}

double StressDrivenChannel::velocity(double y, double t) const {
  if (t <= 0) return 0;
  return nu_ * t < 0.1 * height_ * height_ ? by_images(y, t) : by_modes(y, t);
}

double StressDrivenChannel::gradient(double y, double t) const {
  if (t <= 0) return 0;
  double sum = 0;
  if (nu_ * t < 0.1 * height_ * height_) {
    const double d = 2 * std::sqrt(nu_ * t);
    for (int k = 0;; ++k) {
      const double near = std::erfc(((2 * k + 1) * height_ - y) / d);
      if (k > 0 && near < negligible) return rate_ * sum;
      sum += (k % 2 == 0 ? 1 : -1) * (near + std::erfc(((2 * k + 1) * height_ + y) / d));
    }
  }
  for (int n = 0;; ++n) {
    const double l = (n + 0.5) * pi / height_, decay = std::exp(-nu_ * l * l * t);
    if (decay < negligible) return rate_ * (1 - 2 / height_ * sum);
    sum += (n % 2 == 0 ? 1 : -1) * std::cos(l * y) * decay / l;
  }
}

double StressDrivenChannel::steady_maximum() const {
  return std::abs(rate_) * height_;
}

std::string StressDrivenChannel::description() const {
  return fmt::format("stress-driven Couette start-up, series and images, steady rate {:g} 1/s", rate_);
}

}  // namespace reference
