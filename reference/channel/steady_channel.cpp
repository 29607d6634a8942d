#include "reference/channel/steady_channel.hpp"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_roots.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "reference/gsl_quiet.hpp"
#include "reference/require.hpp"

namespace reference {
namespace {

/// Integral of the rate over stresses from - d to + d around `middle`, divided by 2 d: Gauss, 24 points. For
/// d <= 0.2 |middle| an integrand analytic but for tau = 0 is resolved to (5 + sqrt 24)^-48 = 1e-47.
double mean_rate(const FlowCurve& curve, double middle, double d) {
  static const std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)>
      table(gsl_integration_glfixed_table_alloc(24), &gsl_integration_glfixed_table_free);
  double sum = 0.0;
  for (std::size_t i = 0; i < 24; ++i) {
    double x = 0.0, weight = 0.0;
    gsl_integration_glfixed_point(-1.0, 1.0, i, &x, &weight, table.get());
    sum += 0.5 * weight * curve.rate(middle + d * x);
  }
  return sum;
}

/// Gauss's rule on [low, high], halved until two halves agree with the whole to round-off: for rates with a
/// sharp bend, which a regularised yield stress is. `scale`: of the integral [m2/s3].
double bent_integral(const FlowCurve& curve, double low, double high, double scale, int depth) {
  const auto gauss = [&](double a, double b) {
    return (b - a) * mean_rate(curve, 0.5 * (a + b), 0.5 * (b - a));
  };
  const double middle = 0.5 * (low + high), whole = gauss(low, high);
  const double left = gauss(low, middle), right = gauss(middle, high);
  if (depth == 0 || std::abs(left + right - whole) <= 1e-15 * scale) return left + right;
  return bent_integral(curve, low, middle, scale, depth - 1) +
         bent_integral(curve, middle, high, scale, depth - 1);
}

/// Integral of the rate of a fluid with a yield stress from stress `low` to `high`, from bend to bend.
double yielding_integral(const FlowCurve& curve, double low, double high) {
  const double tau_y = curve.yielding()->tau_y;
  const double scale = (high - low) * std::max(std::abs(curve.rate(low)), std::abs(curve.rate(high)));
  // Beside the yield stress lies a layer of rates of a few 1/m, which a rule over a longer piece would step
  // over without noticing.
  std::vector<double> bends{-tau_y, 0.0, tau_y, high};
  if (std::isfinite(curve.yielding()->m)) {
    for (double x = 0.25; x < 100.0; x *= 2.0) {
      bends.push_back(curve.stress(x / curve.yielding()->m));
      bends.push_back(-bends.back());
    }
  }
  std::sort(bends.begin(), bends.end());
  double sum = 0.0, from = low;
  for (const double bend : bends) {
    const double to = std::min(bend, high);
    if (to <= from) continue;
    sum += bent_integral(curve, from, to, std::abs(scale), 40);
    from = to;
  }
  return sum;
}

}  // namespace

SteadyChannel::SteadyChannel(double height, double body_acceleration, double plate_velocity,
                             const FlowCurve& curve)
    : height_(height), body_acceleration_(body_acceleration), plate_velocity_(plate_velocity), curve_(curve) {
  require(std::isfinite(height) && height > 0.0, "steady channel: the height must be positive and finite");
  require(std::isfinite(body_acceleration), "steady channel: the body acceleration must be finite");
  require(std::isfinite(plate_velocity), "steady channel: the plate velocity must be finite");
  wall_stress_ = 0.5 * body_acceleration * height;
  if (plate_velocity != 0.0) {
    curve_.require_monotone(std::abs(plate_velocity) / height);
    wall_stress_ = body_acceleration == 0.0 ? curve_.stress(plate_velocity / height) : find_wall_stress();
  }
  curve_.require_monotone(largest_rate());
}

double SteadyChannel::stress(double y) const {
  require(y >= 0.0 && y <= height_, "channel: y must lie between the plates");
  return wall_stress_ - body_acceleration_ * y;
}

double SteadyChannel::integrated_rate(double wall_stress, double y) const {
  const double change = body_acceleration_ * y, middle = wall_stress - 0.5 * change;
  if (curve_.yielding()) {
    if (change == 0.0) return y * curve_.rate(wall_stress);
    const double low = std::min(wall_stress, wall_stress - change),
                 high = std::max(wall_stress, wall_stress - change);
    return y * (yielding_integral(curve_, low, high) / (high - low));
  }
  if (std::abs(0.5 * change) <= 0.2 * std::abs(middle)) return y * mean_rate(curve_, middle, 0.5 * change);
  return (curve_.complementary_potential(wall_stress) -
          curve_.complementary_potential(wall_stress - change)) /
         body_acceleration_;
}

double SteadyChannel::find_wall_stress() const {
  quiet_gsl();
  struct Gap {
    const SteadyChannel& channel;
    static double excess(double wall_stress, void* self) {
      const SteadyChannel& c = static_cast<const Gap*>(self)->channel;
      return c.integrated_rate(wall_stress, c.height_) - c.plate_velocity_;
    }
  };
  Gap gap{*this};
  // The mean rate V0/H lies between the rates at the two plates, so its stress lies between the plates'
  // stresses.
  const double mean = curve_.stress(plate_velocity_ / height_), span = body_acceleration_ * height_;
  double low = std::min(mean, mean + span), high = std::max(mean, mean + span);
  if (Gap::excess(low, &gap) >= 0.0) return low;
  if (Gap::excess(high, &gap) <= 0.0) return high;
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  gsl_function f{&Gap::excess, &gap};
  gsl_root_fsolver_set(solver.get(), &f, low, high);
  for (int i = 0; i < 200; ++i) {
    gsl_root_fsolver_iterate(solver.get());
    low = gsl_root_fsolver_x_lower(solver.get());
    high = gsl_root_fsolver_x_upper(solver.get());
    if (high - low <= std::numeric_limits<double>::epsilon() * std::max(std::abs(low), std::abs(high))) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

double SteadyChannel::velocity(double y) const {
  require(y >= 0.0 && y <= height_, "channel: y must lie between the plates");
  if (y == 0.0) return 0.0;
  if (y == height_) return plate_velocity_;
  if (plate_velocity_ == 0.0) y = std::min(y, height_ - y);  // both walls exactly alike
  return integrated_rate(wall_stress_, y);
}

double SteadyChannel::maximum() const {
  const double neutral =
      body_acceleration_ == 0.0 ? -1.0 : wall_stress_ / body_acceleration_;  // where tau = 0
  const double inside = neutral > 0.0 && neutral < height_ ? std::abs(velocity(neutral)) : 0.0;
  return std::max(inside, std::abs(plate_velocity_));
}

double SteadyChannel::largest_rate() const {
  return std::max(std::abs(gradient(0.0)), std::abs(gradient(height_)));
}

std::vector<double> SteadyChannel::linear_scheme_nodes(int cells) const {
  require(cells >= 1, "steady channel: at least one cell is needed");
  require(plate_velocity_ == 0.0, "steady channel: the node rule is for plates at rest");
  const double h = height_ / cells;
  std::vector<double> u(cells + 1, 0.0);
  for (int j = 0; j < (cells + 1) / 2; ++j) {
    u[j + 1] = u[j] + h * curve_.rate(body_acceleration_ * (0.5 * height_ - (j + 0.5) * h));
  }
  for (int j = 0; j <= cells / 2; ++j) u[cells - j] = u[j];
  return u;
}

}  // namespace reference
