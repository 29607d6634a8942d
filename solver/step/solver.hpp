#pragma once

#include "solver/grid/field_samples.hpp"
#include "solver/simulation.hpp"
#include "solver/step/explicit_steps.hpp"
#include "solver/step/passes.hpp"
#include "solver/step/whole_pass_steps.hpp"

namespace mpm {

/// The material point method: a stepping rule over whole passes.
template <class Basis, class Transfer>
class Solver final : public Simulation {
 public:
  Solver(const Scene& scene, const Scheme& scheme, const Transfer& transfer)
      : stepping_(scheme.stepping), passes_(scene, scheme, transfer) {}

  void advance(double t, double dt) override {
    step(t, dt);
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

  [[nodiscard]] Totals totals() const override { return totals_of(passes_.particles(), passes_.impulse()); }

 private:
  void step(double t, double dt) {
    switch (stepping_) {
      case Scheme::Stepping::Usf:
        return step_usf(passes_, t, dt);
      case Scheme::Stepping::Usl:
        return step_usl(passes_, t, dt);
      case Scheme::Stepping::Musl:
        return step_musl(passes_, t, dt);
      case Scheme::Stepping::Leapfrog:
        return step_leapfrog(passes_, t, dt);
      case Scheme::Stepping::ImplicitEuler:
        return step_implicit_euler(passes_, t, dt);
      case Scheme::Stepping::ImplicitSdirk2:
        return step_implicit_sdirk2(passes_, t, dt);
    }
  }

  Scheme::Stepping stepping_;
  Passes<Basis, Transfer> passes_;
};

}  // namespace mpm
