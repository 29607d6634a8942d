#include "reference/surface/gravity_wave.hpp"

#include <cmath>

#include "reference/require.hpp"

namespace reference {
namespace {

using Complex = std::complex<double>;

/// sinh(m y)/sinh(m H) and cosh(m y)/sinh(m H) for 0 <= y, Re m > 0, without overflow.
Complex sinh_ratio(Complex m, double y, double depth) {
  return std::exp(m * (y - depth)) * (1.0 - std::exp(-2.0 * m * y)) / (1.0 - std::exp(-2.0 * m * depth));
}
Complex cosh_ratio(Complex m, double y, double depth) {
  return std::exp(m * (y - depth)) * (1.0 + std::exp(-2.0 * m * y)) / (1.0 - std::exp(-2.0 * m * depth));
}

}  // namespace

GravityWave::GravityWave(const GravityWaveParameters& parameters) : parameters_(parameters) {
  const auto& [k, depth, gravity, nu] = parameters_;
  require(std::isfinite(k) && k > 0, "gravity wave: the wavenumber must be positive and finite");
  require(std::isfinite(depth) && depth > 0, "gravity wave: the depth must be positive and finite");
  require(std::isfinite(gravity) && gravity > 0, "gravity wave: gravity must be positive and finite");
  require(std::isfinite(nu) && nu >= 0, "gravity wave: the viscosity must not be negative");
  rate_ = Complex(-2 * nu * k * k, inviscid_frequency());
  if (nu == 0) return;
  // Newton from Lamb's root; the slope by a complex step of relative size 1e-7 is good enough for it.
  for (int i = 0; i < 100; ++i) {
    const Complex f = dispersion(rate_), step = 1e-7 * rate_;
    const Complex change = f * step / (dispersion(rate_ + step) - f);
    rate_ -= change;
    if (std::abs(change) < 1e-15 * std::abs(rate_)) break;
  }
  require(std::abs(dispersion(rate_)) < 1e-11 * std::norm(rate_) && rate_.imag() > 1e-6 * std::abs(rate_) &&
              rate_.real() < 0,
          "gravity wave: with so large a viscosity it does not oscillate");
}

double GravityWave::inviscid_frequency() const {
  const auto& [k, depth, gravity, nu] = parameters_;
  return std::sqrt(gravity * k * std::tanh(k * depth));
}

Complex GravityWave::dispersion(Complex s) const {
  const auto& [k, depth, gravity, nu] = parameters_;
  const Complex m = std::sqrt(k * k + s / nu), sum = m * m + k * k;
  const double T = std::tanh(k * depth);
  const Complex coth = cosh_ratio(m, depth, depth);
  return s * s + gravity * k * T * (s / nu) / sum + 2 * nu * k * k * s * (1.0 - 2.0 * k * m * T * coth / sum);
}

GravityWave::Velocity GravityWave::velocity(double amplitude, double x, double y, double t) const {
  const auto& [k, depth, gravity, nu] = parameters_;
  // V(H) = 1; the phase makes the surface's displacement V/s vanish at t = 0.
  const Complex factor = rate_ / Complex(0, std::abs(rate_)) * amplitude * std::exp(rate_ * t);
  Complex shape = sinh_ratio(k, y, depth), slope = k * cosh_ratio(k, y, depth);
  if (nu > 0) {
    const Complex m = std::sqrt(k * k + rate_ / nu), part = 2 * k * k / (m * m + k * k);
    shape = (shape - part * sinh_ratio(m, y, depth)) / (1.0 - part);
    slope = (slope - part * m * cosh_ratio(m, y, depth)) / (1.0 - part);
  }
  return {-std::real(factor * slope) / k * std::sin(k * x), std::real(factor * shape) * std::cos(k * x)};
}

}  // namespace reference
