#include "verification/flows/wave_flow.hpp"

#include <numbers>

namespace verification {
namespace {

double wavenumber(const WaveParameters& parameters) {
  return 2 * std::numbers::pi / parameters.wavelength;
}

class AcousticField final : public ExactField {
 public:
  AcousticField(int axis, std::shared_ptr<const reference::AcousticWave> wave)
      : axis_(axis), wave_(std::move(wave)) {}
  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location) const override {
    return wave_->velocity(x[axis_], t) * unit(axis_);
  }
  [[nodiscard]] std::string description() const override {
    return "damped standing sound wave, linear theory";
  }

 private:
  int axis_;
  std::shared_ptr<const reference::AcousticWave> wave_;
};

class ShearField final : public ExactField {
 public:
  explicit ShearField(std::shared_ptr<const reference::ShearWave> wave) : wave_(std::move(wave)) {}
  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location) const override {
    const auto v = wave_->velocity(x.x(), x.y(), t);
    return {v[0], v[1]};
  }
  [[nodiscard]] std::string description() const override {
    return "decaying shear wave, exact Navier-Stokes";
  }

 private:
  std::shared_ptr<const reference::ShearWave> wave_;
};

}  // namespace

mpm::Scene periodic_box(const WaveParameters& parameters, const Discretisation& d) {
  const int across = parameters.axis, along = 1 - across;
  mpm::Scene scene;
  scene.size[across] = parameters.wavelength;
  scene.size[along] = parameters.wavelength / d.cells * d.cells_along;
  scene.cells[static_cast<std::size_t>(across)] = d.cells;
  scene.cells[static_cast<std::size_t>(along)] = d.cells_along;
  scene.particles_per_cell[static_cast<std::size_t>(across)] = d.particles_across;
  scene.particles_per_cell[static_cast<std::size_t>(along)] = d.particles_along;
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
  return std::make_shared<AcousticField>(parameters_.axis, solution_);
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
  return std::make_shared<ShearField>(solution_);
}

Probe ShearWaveFlow::probe() const {
  return {0.25 * parameters_.wavelength * unit(parameters_.axis), unit(1 - parameters_.axis)};
}

}  // namespace verification
