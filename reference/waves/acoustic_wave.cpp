#include "reference/waves/acoustic_wave.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "reference/require.hpp"

namespace reference {

double tait_sound_speed(double bulk_constant, double reference_density) {
  require(std::isfinite(bulk_constant) && bulk_constant > 0.0, "Tait EOS: K must be positive and finite");
  require(std::isfinite(reference_density) && reference_density > 0.0,
          "Tait EOS: the reference density must be positive and finite");
  return std::sqrt(7.0 * bulk_constant / reference_density);
}

AcousticWave::AcousticWave(const AcousticWaveParameters& parameters) : parameters_(parameters) {
  const auto& [amplitude, k, phase, c, nu, rho0] = parameters_;
  require(std::isfinite(amplitude) && std::isfinite(phase),
          "acoustic wave: amplitude and phase must be finite");
  require(std::isfinite(k) && k > 0.0, "acoustic wave: the wavenumber must be positive and finite");
  require(std::isfinite(c) && c > 0.0, "acoustic wave: the sound speed must be positive and finite");
  require(std::isfinite(nu) && nu >= 0.0, "acoustic wave: the viscosity must not be negative");
  require(std::isfinite(rho0) && rho0 > 0.0,
          "acoustic wave: the reference density must be positive and finite");
  damping_ = 2.0 / 3.0 * nu * k * k;
  discriminant_ = (c * k - damping_) * (c * k + damping_);
}

double AcousticWave::angular_frequency() const {
  return discriminant_ > 0.0 ? std::sqrt(discriminant_) : 0.0;
}

double AcousticWave::period() const {
  return discriminant_ > 0.0 ? 2.0 * std::numbers::pi / angular_frequency()
                             : std::numeric_limits<double>::infinity();
}

AcousticWave::Amplitudes AcousticWave::amplitudes(double t) const {
  require(t >= 0.0, "acoustic wave: the time must not be negative");
  // f'' + 2 g f' + c^2 k^2 f = 0 with f(0) = 1 and f'(0) = -2 g (no pressure gradient at the start).
  if (discriminant_ > 0.0) {
    const double omega = std::sqrt(discriminant_), envelope = std::exp(-damping_ * t);
    const double sine = std::sin(omega * t) / omega;
    return {envelope * (std::cos(omega * t) - damping_ * sine), envelope * sine};
  }
  // Written with the slow root taken out, so that nothing overflows however long or however damped.
  const double sigma = std::sqrt(-discriminant_), ck = parameters_.sound_speed * parameters_.wavenumber;
  const double slow = std::exp(-ck * ck / (damping_ + sigma) * t);
  const double ramp = sigma > 0.0 ? -std::expm1(-2.0 * sigma * t) / (2.0 * sigma) : t;
  return {slow * (1.0 - (sigma + damping_) * ramp), slow * ramp};
}

double AcousticWave::velocity(double x, double t) const {
  return parameters_.amplitude * std::sin(parameters_.wavenumber * x + parameters_.phase) *
         amplitudes(t).velocity;
}

double AcousticWave::density_perturbation(double x, double t) const {
  const double k = parameters_.wavenumber;
  return -parameters_.reference_density * k * parameters_.amplitude * std::cos(k * x + parameters_.phase) *
         amplitudes(t).integral;
}

}  // namespace reference
