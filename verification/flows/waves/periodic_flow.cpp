#include "verification/flows/waves/periodic_flow.hpp"

#include <numbers>

#include "reference/compressible/tait_column.hpp"
#include "verification/flows/waves/wave_flow.hpp"

namespace verification {
namespace {

class TranslationField final : public ExactField {
 public:
  TranslationField(const Vec2& velocity, double density) : velocity_(velocity), density_(density) {}
  [[nodiscard]] Vec2 velocity(const Vec2&, double, Location) const override { return velocity_; }
  [[nodiscard]] std::optional<double> density(const Vec2&, double) const override { return density_; }
  [[nodiscard]] std::optional<Vec2> path(const Vec2& start, double t) const override {
    return start + t * velocity_;
  }
  [[nodiscard]] std::string description() const override { return "rigid translation"; }

 private:
  Vec2 velocity_;
  double density_;
};

double angular_wavenumber(int waves, double length) {
  return 2 * std::numbers::pi * waves / length;
}

}  // namespace

mpm::Scene TranslationFlow::scene(const Discretisation& d) const {
  mpm::Scene scene;
  scene.size = {parameters_.length / d.cells * d.cells_along, parameters_.length};
  scene.cells = {d.cells_along, d.cells};
  scene.particles_per_cell = {d.particles_along, d.particles_across};
  scene.fluid = parameters_.fluid;
  scene.initial_velocity = [v = parameters_.velocity](const Vec2&) { return v; };
  scene.initial_density = [rho = parameters_.density_ratio * parameters_.fluid.density](const Vec2&) {
    return rho;
  };
  return scene;
}

std::shared_ptr<const ExactField> TranslationFlow::exact(const std::vector<double>&) const {
  return std::make_shared<TranslationField>(parameters_.velocity,
                                            parameters_.density_ratio * parameters_.fluid.density);
}

double TranslationFlow::pressure_scale() const {
  const double c = parameters_.fluid.sound_speed();
  return parameters_.fluid.density * c * c;
}

Probe TranslationFlow::probe() const {
  return {Vec2(0, 0.5 * parameters_.length), parameters_.velocity.normalized()};
}

ObliqueWaveFlow::ObliqueWaveFlow(const ObliqueWaveParameters& parameters)
    : parameters_(parameters),
      solution_(std::make_shared<reference::ShearWave>(
          reference::ShearWaveParameters{parameters.amplitude,
                                         {angular_wavenumber(parameters.waves[0], parameters.length),
                                          angular_wavenumber(parameters.waves[1], parameters.length)},
                                         parameters.kinematic_viscosity,
                                         {parameters.stream.x(), parameters.stream.y()}})) {}

mpm::Scene ObliqueWaveFlow::scene(const Discretisation& d) const {
  if (d.cells_along != 1)
    throw mpm::SceneError(
        "the box of an oblique wave is square: leave cells_along out, cells count along both sides");
  mpm::Scene scene;
  scene.size = Vec2::Constant(parameters_.length);
  scene.cells = {d.cells, d.cells};
  scene.particles_per_cell = {d.particles_along, d.particles_across};
  scene.fluid = parameters_.fluid;
  scene.initial_velocity = [field = exact({})](const Vec2& x) {
    return field->velocity(x, 0, Location::Particles);
  };
  return scene;
}

std::shared_ptr<const ExactField> ObliqueWaveFlow::exact(const std::vector<double>&) const {
  return shear_wave_field(solution_);
}

Probe ObliqueWaveFlow::probe() const {
  const Vec2 k(parameters_.waves[0], parameters_.waves[1]);
  // A quarter of a wave along k, where the velocity has its first maximum.
  return {0.25 * parameters_.length * k / k.squaredNorm(), Vec2(k.y(), -k.x()).normalized()};
}

}  // namespace verification
