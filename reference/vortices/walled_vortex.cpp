#include "reference/vortices/walled_vortex.hpp"

#include <cmath>
#include <numbers>

#include "reference/require.hpp"

namespace reference {

WalledVortex::WalledVortex(const WalledVortexParameters& parameters)
    : parameters_(parameters), s_(std::numbers::pi / parameters.side) {
  const auto& [side, amplitude, decay_rate, nu] = parameters_;
  require(std::isfinite(side) && side > 0, "walled vortex: the side must be positive");
  require(std::isfinite(amplitude) && amplitude > 0, "walled vortex: the amplitude must be positive");
  require(std::isfinite(decay_rate) && decay_rate >= 0, "walled vortex: the decay rate must not be negative");
  require(std::isfinite(nu) && nu >= 0, "walled vortex: the viscosity must not be negative");
}

std::array<double, 2> WalledVortex::velocity(double x, double y, double t) const {
  const double u = parameters_.amplitude * std::exp(-parameters_.decay_rate * t);
  const double sx = std::sin(s_ * x), sy = std::sin(s_ * y);
  return {u * sx * sx * std::sin(2 * s_ * y), -u * std::sin(2 * s_ * x) * sy * sy};
}

std::array<double, 2> WalledVortex::acceleration(double x, double y, double t) const {
  const double a = parameters_.amplitude * std::exp(-parameters_.decay_rate * t), s = s_;
  // p = sin^2(s x), q = sin(2 s x) = p'/s, c = cos(2 s x) = q'/(2 s); likewise along y.
  const double px = std::pow(std::sin(s * x), 2), qx = std::sin(2 * s * x), cx = std::cos(2 * s * x);
  const double py = std::pow(std::sin(s * y), 2), qy = std::sin(2 * s * y), cy = std::cos(2 * s * y);
  const double u = a * px * qy, v = -a * qx * py;
  const double u_x = a * s * qx * qy, u_y = 2 * a * s * px * cy;
  const double v_x = -2 * a * s * cx * py, v_y = -u_x;
  const double lap_u = 2 * a * s * s * cx * qy - 4 * a * s * s * px * qy;
  const double lap_v = 4 * a * s * s * qx * py - 2 * a * s * s * qx * cy;
  const double rate = parameters_.decay_rate, nu = parameters_.kinematic_viscosity;
  return {-rate * u + u * u_x + v * u_y - nu * lap_u, -rate * v + u * v_x + v * v_y - nu * lap_v};
}

double WalledVortex::rms_speed(double t) const {
  // The mean of sin^4 is 3/8, that of sin^2 a half; two components.
  return std::sqrt(3.0 / 8) * parameters_.amplitude * std::exp(-parameters_.decay_rate * t);
}

}  // namespace reference
