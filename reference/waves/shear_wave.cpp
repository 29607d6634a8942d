#include "reference/waves/shear_wave.hpp"

#include <cmath>

#include "reference/require.hpp"

namespace reference {

ShearWave::ShearWave(const ShearWaveParameters& parameters) : parameters_(parameters) {
  const auto& [amplitude, k, nu, stream] = parameters_;
  const double magnitude = std::hypot(k[0], k[1]);
  require(std::isfinite(amplitude), "shear wave: the amplitude must be finite");
  require(std::isfinite(magnitude) && magnitude > 0.0,
          "shear wave: the wave vector must be finite and not zero");
  require(std::isfinite(nu) && nu >= 0.0, "shear wave: the viscosity must not be negative");
  require(std::isfinite(stream[0]) && std::isfinite(stream[1]),
          "shear wave: the stream velocity must be finite");
}

double ShearWave::decay_rate() const {
  const auto& k = parameters_.wave_vector;
  return parameters_.kinematic_viscosity * (k[0] * k[0] + k[1] * k[1]);
}

std::array<double, 2> ShearWave::velocity(double x, double y, double t) const {
  const auto& k = parameters_.wave_vector;
  const auto& w = parameters_.stream_velocity;
  const double wave = parameters_.amplitude * std::sin(k[0] * (x - w[0] * t) + k[1] * (y - w[1] * t)) *
                      std::exp(-decay_rate() * t) / std::hypot(k[0], k[1]);
  return {w[0] + k[1] * wave, w[1] - k[0] * wave};
}

std::array<double, 2> ShearWave::path(double x, double y, double t) const {
  const auto& k = parameters_.wave_vector;
  const auto& w = parameters_.stream_velocity;
  const double rate = decay_rate();
  const double time = rate > 0.0 ? -std::expm1(-rate * t) / rate : t;  // integral of the decay
  const double slide = parameters_.amplitude * std::sin(k[0] * x + k[1] * y) * time / std::hypot(k[0], k[1]);
  return {x + w[0] * t + k[1] * slide, y + w[1] * t - k[0] * slide};
}

}  // namespace reference
