#include "reference/vortices/manufactured_flow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/require.hpp"

namespace reference {

ManufacturedFlow::ManufacturedFlow(const ManufacturedParameters& parameters)
    : parameters_(parameters),
      k_(2 * std::numbers::pi / parameters.length),
      q_(2 * std::numbers::pi / parameters.height) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  require(positive(parameters.height), "manufactured flow: the height must be positive");
  require(positive(parameters.length), "manufactured flow: the length must be positive");
  require(positive(parameters.plate_velocity), "manufactured flow: the plate velocity must be positive");
  require(std::isfinite(parameters.amplitude) && parameters.amplitude >= 0,
          "manufactured flow: the amplitude must not be negative");
  require(std::isfinite(parameters.angular_frequency), "manufactured flow: the frequency must be finite");
  require(least_shear_rate() > 0,
          "manufactured flow: the wave's amplitude must be below V0/(H max(q, |2 k^2/q - q|)), q = 2 pi/H, "
          "k = 2 pi/L, or the shear rate could vanish");
}

double ManufacturedFlow::least_shear_rate() const {
  // gdot >= 2 |D12| = |V0/H + a sin(theta) (q C + k^2/q (1 - C))|, C = cos(2 pi y/H): linear in C.
  const double wave = std::max(q_, std::abs(2 * k_ * k_ / q_ - q_));
  return parameters_.plate_velocity / parameters_.height - parameters_.amplitude * wave;
}

std::array<double, 2> ManufacturedFlow::velocity(double x, double y, double t) const {
  const double theta = k_ * x - parameters_.angular_frequency * t, a = parameters_.amplitude;
  return {parameters_.plate_velocity * y / parameters_.height + a * std::sin(q_ * y) * std::sin(theta),
          -a * (k_ / q_) * (1 - std::cos(q_ * y)) * std::cos(theta)};
}

std::array<double, 2> ManufacturedFlow::acceleration(double x, double y, double t) const {
  const double a = parameters_.amplitude, omega = parameters_.angular_frequency, k = k_, q = q_;
  const double theta = k * x - omega * t;
  const double sin_x = std::sin(theta), cos_x = std::cos(theta);
  const double sin_y = std::sin(q * y), cos_y = std::cos(q * y), bump = (k / q) * (1 - cos_y);
  const double shear = parameters_.plate_velocity / parameters_.height;

  const double u = shear * y + a * sin_y * sin_x, v = -a * bump * cos_x;
  const double u_t = -omega * a * sin_y * cos_x, v_t = -omega * a * bump * sin_x;
  const double u_x = a * k * sin_y * cos_x, u_y = shear + a * q * cos_y * sin_x;
  const double v_x = a * k * bump * sin_x, v_y = -u_x;
  const double u_xx = -a * k * k * sin_y * sin_x, u_xy = a * k * q * cos_y * cos_x;
  const double u_yy = -a * q * q * sin_y * sin_x;
  const double v_xx = a * k * k * bump * cos_x, v_xy = -u_xx, v_yy = -u_xy;

  const double d11 = u_x, d12 = 0.5 * (u_y + v_x), d22 = v_y;
  const double d11_x = u_xx, d11_y = u_xy, d22_y = v_yy;
  const double d12_x = 0.5 * (u_xy + v_xx), d12_y = 0.5 * (u_yy + v_xy);
  const double rate = 2 * std::sqrt(d11 * d11 + d12 * d12);  // d22 = -d11
  const double nu = parameters_.curve.viscosity(rate);
  const double nu_slope = (parameters_.curve.slope(rate) - nu) / rate;  // d nu/d gdot, of tau = nu gdot
  const double nu_x = nu_slope * 4 * (d11 * d11_x + d12 * d12_x) / rate;
  const double nu_y = nu_slope * 4 * (d11 * d11_y + d12 * d12_y) / rate;

  return {u_t + u * u_x + v * u_y - 2 * (nu * (d11_x + d12_y) + nu_x * d11 + nu_y * d12),
          v_t + u * v_x + v * v_y - 2 * (nu * (d12_x + d22_y) + nu_x * d12 + nu_y * d22)};
}

}  // namespace reference
