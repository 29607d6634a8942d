#pragma once

#include <cmath>
#include <numbers>

#include "verification/flows/flow.hpp"

namespace verification {

/// A jet between two shear layers that roll up (Bell, Colella & Glaz, J. Comput. Phys. 85 (1989) 257; Minion
/// & Brown, J. Comput. Phys. 138 (1997) 734).
struct DoubleShearLayerParameters {
  double period = 0;       ///< L of the square, periodic box [m]
  double amplitude = 0;    ///< U [m/s]
  double thickness = 0;    ///< d of a layer [m]
  double disturbance = 0;  ///< e: of the velocity across the layers, over U
  mpm::Fluid fluid;
};

/// At t = 0: u = U tanh((y - L/4)/d) below L/2, U tanh((3 L/4 - y)/d) above, v = e U sin(2 pi x/L). No exact
/// solution: a fine run is what others are held against.
class DoubleShearLayerFlow final : public Flow {
 public:
  explicit DoubleShearLayerFlow(const DoubleShearLayerParameters& parameters) : parameters_(parameters) {}

  [[nodiscard]] mpm::Scene scene(const Discretisation& d) const override {
    mpm::Scene scene;
    scene.size = Vec2::Constant(parameters_.period);
    scene.cells = {d.cells, d.cells};
    scene.particles_per_cell = {d.particles_along, d.particles_across};
    scene.initial_velocity = [p = parameters_](const Vec2& x) -> Vec2 {
      const double from_layer = x.y() <= 0.5 * p.period ? x.y() - 0.25 * p.period : 0.75 * p.period - x.y();
      return p.amplitude * Vec2(std::tanh(from_layer / p.thickness),
                                p.disturbance * std::sin(2 * std::numbers::pi * x.x() / p.period));
    };
    scene.fluid = parameters_.fluid;
    return scene;
  }
  [[nodiscard]] bool has_exact() const override { return false; }
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>&) const override {
    return nullptr;
  }
  [[nodiscard]] double velocity_scale() const override { return parameters_.amplitude; }
  [[nodiscard]] Probe probe() const override { return {parameters_.period * Vec2(0.5, 0.25), Vec2(1, 0)}; }
  [[nodiscard]] int across() const override { return 1; }
  [[nodiscard]] double length() const override { return parameters_.period; }

 private:
  DoubleShearLayerParameters parameters_;
};

}  // namespace verification
