#pragma once

#include <algorithm>

#include "solver/grid/field_samples.hpp"
#include "solver/lanes/full_mass_passes.hpp"
#include "solver/simulation.hpp"
#include "solver/step/whole_pass_steps.hpp"

namespace mpm {

/// Whether a FullMassSolver covers a scheme on a scene: leapfrog steps of the consistent mass in a plane full
/// of fluid between walls that stick. A periodic axis must be longer than a row of the mass matrix, 2 degree
/// + 1 nodes: on a shorter one a node meets a neighbour on both sides.
template <class Basis>
bool full_mass_lanes_cover(const Scene& scene, const Scheme& scheme) {
  for (const int axis : {0, 1})
    if (scene.periodic(axis) && scene.cells[static_cast<std::size_t>(axis)] <= 2 * Basis::degree)
      return false;
  const bool slips = std::any_of(scene.sides.begin(), scene.sides.end(), [](const Side& side) {
    return !side.periodic && (side.slip_length != 0 || side.traction != 0);
  });
  return scheme.transfer == Scheme::Transfer::FullMass && scheme.stepping == Scheme::Stepping::Leapfrog &&
         scheme.dilatation == Scheme::Dilatation::Particle && !scene.free_surface && !slips;
}

/// The leapfrog of the consistent mass on the vector kernels: the same scheme as Solver, several times
/// faster.
template <class Basis>
class FullMassSolver final : public Simulation {
 public:
  FullMassSolver(const Scene& scene, const Scheme& scheme, int threads) : passes_(scene, scheme, threads) {}

  void advance(double t, double dt) override {
    step_leapfrog(passes_, t, dt);
    passes_.reset_if_due(t, dt);
  }

  [[nodiscard]] std::optional<std::string> breakdown() const override { return passes_.breakdown(); }
  [[nodiscard]] const Particles& particles() const override { return passes_.particles(); }

  [[nodiscard]] VectorField grid_field(const VectorField& points, double t) const override {
    const Grid& grid = passes_.mapped_grid(t);
    return field_at<Basis>(grid, grid.velocity, points);
  }

  [[nodiscard]] std::vector<Mat2> grid_gradient(const VectorField& points, double t) const override {
    const Grid& grid = passes_.mapped_grid(t);
    return gradient_at<Basis>(grid, grid.velocity, points);
  }

  [[nodiscard]] Totals totals() const override { return passes_.totals(); }

 private:
  FullMassPasses<Basis> passes_;
};

}  // namespace mpm
