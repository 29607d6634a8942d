#include "reference/channel/newtonian_channel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reference/ierfc.hpp"
#include "reference/require.hpp"

namespace reference {
namespace {

using std::numbers::pi;

constexpr double kNegligible = 1e-18;  // a term of this relative size cannot change a double
constexpr double kSwitch = 0.1;        // nu t/H^2 at which both series need about five terms

void check(double y, double t, double height, double nu, double drive) {
  require(std::isfinite(height) && height > 0.0, "channel: the height must be positive and finite");
  require(std::isfinite(nu) && nu > 0.0, "channel: the kinematic viscosity must be positive and finite");
  require(std::isfinite(drive), "channel: body acceleration and plate velocity must be finite");
  require(y >= 0.0 && y <= height, "channel: y must lie between the plates");
  require(t >= 0.0, "channel: the time must not be negative");
}

void check_fourier(double y, double t, double height, double nu, double drive) {
  check(y, t, height, nu, drive);
  require(nu * t >= 1e-10 * height * height, "channel: the Fourier series needs nu t/H^2 >= 1e-10");
}

void check_images(double y, double t, double height, double nu, double drive) {
  check(y, t, height, nu, drive);
  require(nu * t <= 1e10 * height * height, "channel: the image series needs nu t/H^2 <= 1e10");
}

/// sum_m amplitude(m) exp(-m^2 s), m = first, first + stride, ..., for |amplitude| <= 1 and not growing. What
/// is left out after m is below exp(-m^2 s)/(1 - exp(-2 m s)) of the first amplitude: the exponents grow by
/// more than 2 m s.
template <class Amplitude>
double decaying_sum(int first, int stride, double s, Amplitude amplitude) {
  double sum = 0.0;
  for (int m = first;; m += stride) {
    const double decay = std::exp(-double(m) * m * s);
    if (decay <= kNegligible * -std::expm1(-2.0 * m * s)) return sum;
    sum += amplitude(m) * decay;
  }
}

/// Number of images beyond which every one is below kNegligible: ierfc, i2erfc and erfc are all at most
/// exp(-x^2), image k sits at x >= k H/d, and successive ones shrink at least as fast as a geometric series
/// there.
int image_count(double height, double d) {
  return 2 + static_cast<int>(std::sqrt(-std::log(kNegligible)) * d / height);
}

double i2erfc(double x) {
  return 0.25 * ((1.0 + 2.0 * x * x) * std::erfc(x) - 2.0 * x * std::exp(-x * x) / std::sqrt(pi));
}

double sign(int k) {
  return k % 2 == 0 ? 1.0 : -1.0;
}

}  // namespace

double poiseuille_fourier(double y, double t, double height, double nu, double body_acceleration) {
  check_fourier(y, t, height, nu, body_acceleration);
  const double near_wall = std::min(y, height - y);  // makes both walls exactly alike
  const double theta = pi * near_wall / height;
  const double transient = decaying_sum(1, 2, pi * pi * (nu * t / (height * height)),
                                        [&](int m) { return std::sin(m * theta) / (double(m) * m * m); });
  return body_acceleration / nu *
         (0.5 * y * (height - y) - 4.0 * height * height / (pi * pi * pi) * transient);
}

double poiseuille_fourier_gradient(double y, double t, double height, double nu, double body_acceleration) {
  check_fourier(y, t, height, nu, body_acceleration);
  const double theta = pi * y / height;
  const double transient = decaying_sum(1, 2, pi * pi * (nu * t / (height * height)),
                                        [&](int m) { return std::cos(m * theta) / (double(m) * m); });
  return body_acceleration / nu * (0.5 * (height - 2.0 * y) - 4.0 * height / (pi * pi) * transient);
}

double couette_fourier(double y, double t, double height, double nu, double plate_velocity) {
  check_fourier(y, t, height, nu, plate_velocity);
  if (y == height) return plate_velocity;
  const double theta = pi * y / height;
  const double transient = decaying_sum(1, 1, pi * pi * (nu * t / (height * height)),
                                        [&](int n) { return sign(n) * std::sin(n * theta) / n; });
  return plate_velocity * (y / height + 2.0 / pi * transient);
}

double couette_fourier_gradient(double y, double t, double height, double nu, double plate_velocity) {
  check_fourier(y, t, height, nu, plate_velocity);
  const double theta = pi * y / height;
  const double transient = decaying_sum(1, 1, pi * pi * (nu * t / (height * height)),
                                        [&](int n) { return sign(n) * std::cos(n * theta); });
  return plate_velocity / height * (1.0 + 2.0 * transient);
}

double poiseuille_images(double y, double t, double height, double nu, double body_acceleration) {
  check_images(y, t, height, nu, body_acceleration);
  if (t == 0.0 || y == 0.0 || y == height) return 0.0;
  const double d = 2.0 * std::sqrt(nu * t);
  double sum = 0.0;
  for (int k = 0, n = image_count(height, d); k < n; ++k) {
    sum += sign(k) * (i2erfc((k * height + y) / d) + i2erfc(((k + 1) * height - y) / d));
  }
  return body_acceleration * t * (1.0 - 4.0 * sum);
}

double poiseuille_images_gradient(double y, double t, double height, double nu, double body_acceleration) {
  check_images(y, t, height, nu, body_acceleration);
  if (t == 0.0) return 0.0;
  const double d = 2.0 * std::sqrt(nu * t);
  double sum = 0.0;
  for (int k = 0, n = image_count(height, d); k < n; ++k) {
    sum += sign(k) * (ierfc((k * height + y) / d) - ierfc(((k + 1) * height - y) / d));
  }
  return 4.0 * body_acceleration * t / d * sum;
}

double couette_images(double y, double t, double height, double nu, double plate_velocity) {
  check_images(y, t, height, nu, plate_velocity);
  if (y == height) return plate_velocity;
  if (t == 0.0) return 0.0;
  const double d = 2.0 * std::sqrt(nu * t);
  double sum = 0.0;
  for (int k = 0, n = image_count(height, d); k < n; ++k) {
    sum += std::erfc(((2 * k + 1) * height - y) / d) - std::erfc(((2 * k + 1) * height + y) / d);
  }
  return plate_velocity * sum;
}

double couette_images_gradient(double y, double t, double height, double nu, double plate_velocity) {
  check_images(y, t, height, nu, plate_velocity);
  if (plate_velocity == 0.0) return 0.0;
  if (t == 0.0)
    return y == height ? std::copysign(std::numeric_limits<double>::infinity(), plate_velocity) : 0.0;
  const double d = 2.0 * std::sqrt(nu * t);
  const auto gauss = [](double x) { return std::exp(-x * x); };
  double sum = 0.0;
  for (int k = 0, n = image_count(height, d); k < n; ++k) {
    sum += gauss(((2 * k + 1) * height - y) / d) + gauss(((2 * k + 1) * height + y) / d);
  }
  return plate_velocity * 2.0 / (d * std::sqrt(pi)) * sum;
}

NewtonianChannel::NewtonianChannel(const NewtonianChannelParameters& parameters) : parameters_(parameters) {
  const auto& [height, nu, force, plate] = parameters_;
  check(0.0, 0.0, height, nu, force);
  check(0.0, 0.0, height, nu, plate);
  steady_maximum_ = std::abs(plate);
  const double extremum = force == 0.0 ? height : 0.5 * height + nu * plate / (force * height);
  if (extremum > 0.0 && extremum < height) {
    steady_maximum_ = std::max(steady_maximum_, std::abs(0.5 * force / nu * extremum * (height - extremum) +
                                                         plate * extremum / height));
  }
}

bool NewtonianChannel::early(double t) const {
  return parameters_.kinematic_viscosity * t < kSwitch * parameters_.height * parameters_.height;
}

double NewtonianChannel::velocity(double y, double t) const {
  const auto& [height, nu, force, plate] = parameters_;
  if (early(t)) return poiseuille_images(y, t, height, nu, force) + couette_images(y, t, height, nu, plate);
  return poiseuille_fourier(y, t, height, nu, force) + couette_fourier(y, t, height, nu, plate);
}

double NewtonianChannel::gradient(double y, double t) const {
  const auto& [height, nu, force, plate] = parameters_;
  if (early(t)) {
    return poiseuille_images_gradient(y, t, height, nu, force) +
           couette_images_gradient(y, t, height, nu, plate);
  }
  return poiseuille_fourier_gradient(y, t, height, nu, force) +
         couette_fourier_gradient(y, t, height, nu, plate);
}

std::string NewtonianChannel::description() const {
  const auto& [height, nu, force, plate] = parameters_;
  return fmt::format(
      "exact series, Newtonian channel: H = {:g} m, nu = {:g} m2/s, F = {:g} m/s2, V0 = {:g} m/s", height, nu,
      force, plate);
}

}  // namespace reference
