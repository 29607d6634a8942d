#include "reference/channel/ideal_yield_channel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reference/require.hpp"

namespace reference {

IdealYieldChannel::IdealYieldChannel(double height, double body_acceleration, double plate_velocity,
                                     const HerschelBulkleyCurve& curve)
    : height_(height),
      body_acceleration_(body_acceleration),
      plate_velocity_(plate_velocity),
      curve_(curve.ideal()) {
  curve_.check();
  require(std::isfinite(height) && height > 0.0, "ideal channel: the height must be positive and finite");
  require(std::isfinite(body_acceleration) && std::isfinite(plate_velocity),
          "ideal channel: the drive must be finite");
  require(body_acceleration != 0.0 || plate_velocity != 0.0, "ideal channel: nothing drives the flow");
  wall_stress_ = 0.5 * body_acceleration * height;
  if (plate_velocity != 0.0) wall_stress_ = find_wall_stress();
}

double IdealYieldChannel::potential(double tau) const {
  const double beyond = std::max(std::abs(tau) - curve_.tau_y, 0.0);
  return curve_.n / (curve_.n + 1.0) * beyond * std::pow(beyond / curve_.nu_0, 1.0 / curve_.n);
}

double IdealYieldChannel::reached(double wall_stress, double y) const {
  return (potential(wall_stress) - potential(wall_stress - body_acceleration_ * y)) / body_acceleration_;
}

double IdealYieldChannel::find_wall_stress() const {
  const double mean_rate = plate_velocity_ / height_;
  const double mean =
      std::copysign(curve_.tau_y + curve_.nu_0 * std::pow(std::abs(mean_rate), curve_.n), plate_velocity_);
  if (body_acceleration_ == 0.0) return mean;
  // The velocity reached at H grows with the wall's stress. Where nothing is sheared between two stresses it
  // does not, but there it is zero, and V0 is not. Bisection to the last bit; the mean rate's stress lies in
  // between.
  const double span = body_acceleration_ * height_;
  double low = std::min(mean, mean + span), high = std::max(mean, mean + span);
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return middle;
    (reached(middle, height_) < plate_velocity_ ? low : high) = middle;
  }
}

double IdealYieldChannel::velocity(double y, double) const {
  require(y >= 0.0 && y <= height_, "channel: y must lie between the plates");
  if (y == 0.0) return 0.0;
  if (y == height_) return plate_velocity_;
  if (body_acceleration_ == 0.0) return plate_velocity_ * (y / height_);
  if (plate_velocity_ == 0.0) y = std::min(y, height_ - y);  // both walls exactly alike
  return reached(wall_stress_, y);
}

double IdealYieldChannel::gradient(double y, double) const {
  require(y >= 0.0 && y <= height_, "channel: y must lie between the plates");
  const double tau = stress(y), beyond = std::abs(tau) - curve_.tau_y;
  return beyond > 0.0 ? std::copysign(std::pow(beyond / curve_.nu_0, 1.0 / curve_.n), tau) : 0.0;
}

double IdealYieldChannel::plug_begin() const {
  if (body_acceleration_ == 0.0) return 0.0;
  const double middle = wall_stress_ / body_acceleration_, half = curve_.tau_y / std::abs(body_acceleration_);
  return std::clamp(middle - half, 0.0, height_);
}

double IdealYieldChannel::plug_end() const {
  if (body_acceleration_ == 0.0) return 0.0;
  const double middle = wall_stress_ / body_acceleration_, half = curve_.tau_y / std::abs(body_acceleration_);
  return std::clamp(middle + half, 0.0, height_);
}

double IdealYieldChannel::steady_maximum() const {
  const double inside =
      body_acceleration_ == 0.0 ? 0.0 : std::abs(velocity(0.5 * (plug_begin() + plug_end())));
  return std::max(inside, std::abs(plate_velocity_));
}

std::string IdealYieldChannel::description() const {
  return fmt::format("steady flow of the ideal fluid: H = {:g} m, F = {:g} m/s2, V0 = {:g} m/s, {}", height_,
                     body_acceleration_, plate_velocity_, curve_.describe());
}

}  // namespace reference
