#include "reference/channel/oscillating_channel.hpp"

#include <cmath>

#include "reference/require.hpp"

namespace reference {
namespace {

using Complex = std::complex<double>;

/// 1 - exp(-z) without cancellation.
Complex one_minus_exp(Complex z) {
  // exp(-z) - 1 = expm1(-a) cos b + (cos b - 1) - i exp(-a) sin b for z = a + i b.
  const double a = z.real(), b = z.imag(), half = std::sin(0.5 * b);
  return {-(std::expm1(-a) * std::cos(b) - 2.0 * half * half), std::exp(-a) * std::sin(b)};
}

/// sinh(a)/sinh(b) for Re b >= Re a >= 0.
Complex sinh_ratio(Complex a, Complex b) {
  return std::exp(a - b) * one_minus_exp(2.0 * a) / one_minus_exp(2.0 * b);
}

/// 1 - cosh(a)/cosh(b) = 2 sinh((b + a)/2) sinh((b - a)/2)/cosh(b), for Re b >= Re a >= 0.
Complex one_minus_cosh_ratio(Complex a, Complex b) {
  return one_minus_exp(b + a) * one_minus_exp(b - a) / (1.0 + std::exp(-2.0 * b));
}

}  // namespace

OscillatingChannel::OscillatingChannel(const OscillatingChannelParameters& parameters)
    : parameters_(parameters) {
  const auto& [height, nu, omega, force, plate] = parameters_;
  require(std::isfinite(height) && height > 0.0,
          "oscillating channel: the height must be positive and finite");
  require(std::isfinite(nu) && nu > 0.0, "oscillating channel: the viscosity must be positive and finite");
  require(std::isfinite(omega) && omega > 0.0,
          "oscillating channel: the angular frequency must be positive and finite");
  require(std::isfinite(force) && std::isfinite(plate),
          "oscillating channel: body acceleration and plate velocity must be finite");
  require(force != 0.0 || plate != 0.0, "oscillating channel: nothing drives the flow");
  lambda_ = Complex(1.0, 1.0) * std::sqrt(0.5 * omega / nu);
}

std::complex<double> OscillatingChannel::amplitude(double y) const {
  const auto& [height, nu, omega, force, plate] = parameters_;
  require(y >= 0.0 && y <= height, "oscillating channel: y must lie in the gap");
  const double z = std::abs(y - 0.5 * height);
  return plate * sinh_ratio(lambda_ * y, lambda_ * height) +
         force / Complex(0.0, omega) * one_minus_cosh_ratio(lambda_ * z, 0.5 * lambda_ * height);
}

double OscillatingChannel::velocity(double y, double t) const {
  return (amplitude(y) * std::polar(1.0, parameters_.angular_frequency * t)).real();
}

double OscillatingChannel::womersley_number() const {
  return 0.5 * parameters_.height *
         std::sqrt(parameters_.angular_frequency / parameters_.kinematic_viscosity);
}

}  // namespace reference
