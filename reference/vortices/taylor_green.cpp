#include "reference/vortices/taylor_green.hpp"

#include <cmath>
#include <numbers>

#include "reference/require.hpp"

namespace reference {

TaylorGreen::TaylorGreen(const TaylorGreenParameters& parameters)
    : parameters_(parameters), wavenumber_(2 * std::numbers::pi / parameters.period) {
  const auto& [amplitude, period, nu, density] = parameters_;
  require(std::isfinite(amplitude) && amplitude > 0, "Taylor-Green: the amplitude must be positive");
  require(std::isfinite(period) && period > 0, "Taylor-Green: the period must be positive");
  require(std::isfinite(nu) && nu >= 0, "Taylor-Green: the viscosity must not be negative");
  require(std::isfinite(density) && density > 0, "Taylor-Green: the density must be positive");
}

std::array<double, 2> TaylorGreen::velocity(double x, double y, double t) const {
  const double k = wavenumber_, u = parameters_.amplitude * std::exp(-decay_rate() * t);
  return {u * std::sin(k * x) * std::cos(k * y), -u * std::cos(k * x) * std::sin(k * y)};
}

double TaylorGreen::pressure(double x, double y, double t) const {
  const double k = wavenumber_, u = parameters_.amplitude * std::exp(-decay_rate() * t);
  return 0.25 * parameters_.density * u * u * (std::cos(2 * k * x) + std::cos(2 * k * y));
}

double TaylorGreen::decay_rate() const {
  return 2 * parameters_.kinematic_viscosity * wavenumber_ * wavenumber_;
}

double TaylorGreen::rms_speed(double t) const {
  return parameters_.amplitude * std::exp(-decay_rate() * t) / std::numbers::sqrt2;
}

double TaylorGreen::kinetic_energy(double t) const {
  const double speed = rms_speed(t), length = parameters_.period;
  return 0.5 * parameters_.density * length * length * speed * speed;
}

}  // namespace reference
