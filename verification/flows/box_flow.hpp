#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "verification/flows/flow.hpp"
#include "verification/flows/surface/column_at_rest.hpp"

namespace verification {

/// A rectangle with any sides, body acceleration and uniform initial velocity, full of fluid or with a part
/// of it, for which no exact solution is known: runs of it are recorded, not judged against a solution.
struct BoxParameters {
  Vec2 size{0, 0};                            ///< [m]
  std::array<mpm::Side, 4> sides;             ///< indexed by mpm::Edge
  Vec2 body_acceleration = Vec2::Zero();      ///< [m/s2]
  Vec2 initial_velocity = Vec2::Zero();       ///< [m/s]
  double velocity_scale = 0;                  ///< [m/s]
  std::function<bool(const Vec2&)> is_fluid;  ///< the part that fluid fills at the start; all when empty
  /// Height up to which it stands in hydrostatic equilibrium of the grid (ColumnAtRest) at the start under
  /// the acceleration along y [m];
  /// NaN: at the reference density.
  double surface = std::numeric_limits<double>::quiet_NaN();
  mpm::Fluid fluid;
};

class BoxFlow final : public Flow {
 public:
  explicit BoxFlow(const BoxParameters& parameters) : parameters_(parameters) {}

  [[nodiscard]] mpm::Scene scene(const Discretisation& d) const override {
    mpm::Scene scene;
    scene.size = parameters_.size;
    scene.cells = {d.cells_along, d.cells};
    scene.particles_per_cell = {d.particles_along, d.particles_across};
    scene.sides = parameters_.sides;
    scene.body_acceleration = [b = parameters_.body_acceleration](double) { return b; };
    scene.initial_velocity = [v = parameters_.initial_velocity](const Vec2&) { return v; };
    scene.fluid = parameters_.fluid;
    if (parameters_.is_fluid) scene.free_surface = mpm::FreeSurface{parameters_.is_fluid};
    if (std::isfinite(parameters_.surface)) {
      scene.initial_density = density_at_rest(
          {parameters_.surface, -parameters_.body_acceleration.y(), scene.cell_size(1), d.particles_across},
          parameters_.fluid);
    }
    return scene;
  }
  [[nodiscard]] bool has_exact() const override { return false; }
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>&) const override {
    return nullptr;
  }
  [[nodiscard]] double velocity_scale() const override { return parameters_.velocity_scale; }
  [[nodiscard]] Probe probe() const override { return {0.5 * parameters_.size, Vec2(1, 0)}; }
  [[nodiscard]] int across() const override { return 1; }
  [[nodiscard]] double length() const override { return parameters_.size.y(); }

 private:
  BoxParameters parameters_;
};

}  // namespace verification
