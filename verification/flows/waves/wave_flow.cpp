#include "verification/flows/waves/wave_flow.hpp"

#include <numbers>

#include "verification/flows/layer.hpp"

namespace verification {
namespace {

double wavenumber(const WaveParameters& parameters) {
  return 2 * std::numbers::pi / parameters.wavelength;
}

class AcousticField final : public ExactField {
 public:
  AcousticField(int axis, double density, std::shared_ptr<const reference::AcousticWave> wave)
      : axis_(axis), density_(density), wave_(std::move(wave)) {}
  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location) const override {
    return wave_->velocity(x[axis_], t) * unit(axis_);
  }
  [[nodiscard]] std::optional<double> density(const Vec2& x, double t) const override {
    return density_ + wave_->density_perturbation(x[axis_], t);
  }
  [[nodiscard]] std::string description() const override {
    return "damped standing sound wave, linear theory";
  }

 private:
  int axis_;
  double density_;  // at rest [kg/m3]
  std::shared_ptr<const reference::AcousticWave> wave_;
};

class ShearField final : public ExactField {
 public:
  explicit ShearField(std::shared_ptr<const reference::ShearWave> wave) : wave_(std::move(wave)) {}
  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location) const override {
    const auto v = wave_->velocity(x.x(), x.y(), t);
    return {v[0], v[1]};
  }
  [[nodiscard]] std::optional<Vec2> path(const Vec2& start, double t) const override {
    const auto x = wave_->path(start.x(), start.y(), t);
    return Vec2(x[0], x[1]);
  }
  [[nodiscard]] std::string description() const override {
    return "decaying shear wave, exact Navier-Stokes";
  }

 private:
  std::shared_ptr<const reference::ShearWave> wave_;
};

}  // namespace

std::shared_ptr<const ExactField> shear_wave_field(std::shared_ptr<const reference::ShearWave> wave) {
  return std::make_shared<ShearField>(std::move(wave));
}

mpm::Scene periodic_box(const WaveParameters& parameters, const Discretisation& d) {
  mpm::Scene scene = layer(parameters.wavelength, 1 - parameters.axis, d);
  scene.fluid = parameters.fluid;
  return scene;
}

AcousticWaveFlow::AcousticWaveFlow(const WaveParameters& parameters)
    : parameters_(parameters),
      solution_(std::make_shared<reference::AcousticWave>(reference::AcousticWaveParameters{
          parameters.amplitude, wavenumber(parameters), 0,
          reference::tait_sound_speed(parameters.fluid.bulk_modulus, parameters.fluid.density),
          parameters.kinematic_viscosity, parameters.fluid.density})) {}

mpm::Scene AcousticWaveFlow::scene(const Discretisation& discretisation) const {
  mpm::Scene scene = periodic_box(parameters_, discretisation);
  scene.initial_velocity = [axis = parameters_.axis, wave = solution_](const Vec2& x) -> Vec2 {
    return wave->velocity(x[axis], 0) * unit(axis);
  };
  return scene;
}

std::shared_ptr<const ExactField> AcousticWaveFlow::exact(const std::vector<double>&) const {
  return std::make_shared<AcousticField>(parameters_.axis, parameters_.fluid.density, solution_);
}

double AcousticWaveFlow::pressure_scale() const {
  return parameters_.fluid.density * parameters_.fluid.sound_speed() * parameters_.amplitude;
}

std::optional<Oscillation> AcousticWaveFlow::oscillation() const {
  if (solution_->angular_frequency() == 0) return std::nullopt;  // overdamped
  return Oscillation{solution_->angular_frequency(), solution_->damping_rate()};
}

Probe AcousticWaveFlow::probe() const {
  return {0.25 * parameters_.wavelength * unit(parameters_.axis), unit(parameters_.axis)};
}

ShearWaveFlow::ShearWaveFlow(const WaveParameters& parameters)
    : parameters_(parameters),
      solution_(std::make_shared<reference::ShearWave>(
          reference::ShearWaveParameters{parameters.amplitude,
                                         {wavenumber(parameters) * unit(parameters.axis).x(),
                                          wavenumber(parameters) * unit(parameters.axis).y()},
                                         parameters.kinematic_viscosity,
                                         {parameters.stream.x(), parameters.stream.y()}})) {}

mpm::Scene ShearWaveFlow::scene(const Discretisation& discretisation) const {
  mpm::Scene scene = periodic_box(parameters_, discretisation);
  scene.initial_velocity = [field = ShearField(solution_)](const Vec2& x) {
    return field.velocity(x, 0, Location::Particles);
  };
  return scene;
}

std::shared_ptr<const ExactField> ShearWaveFlow::exact(const std::vector<double>&) const {
  return shear_wave_field(solution_);
}

Probe ShearWaveFlow::probe() const {
  return {0.25 * parameters_.wavelength * unit(parameters_.axis), unit(1 - parameters_.axis)};
}

}  // namespace verification
