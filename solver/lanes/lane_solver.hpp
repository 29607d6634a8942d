#pragma once

#include "solver/grid/field_samples.hpp"
#include "solver/lanes/lane_passes.hpp"
#include "solver/simulation.hpp"

namespace mpm {

/// Whether a LaneSolver covers a scheme on a scene: lumped mass with particles that carry a velocity or an
/// affine field, explicit steps of first order, no acceleration that varies in space, no reset of particles.
inline bool lanes_cover(const Scene& scene, const Scheme& scheme) {
  using T = Scheme::Transfer;
  using S = Scheme::Stepping;
  const bool transfer = scheme.transfer != T::FullMass;
  const bool stepping = scheme.stepping == S::Usf || scheme.stepping == S::Usl || scheme.stepping == S::Musl;
  return transfer && stepping && !scene.acceleration_field && !scheme.resets();
}

/// The material point method on the vector kernels: the same schemes as Solver, an order of magnitude faster.
template <class Basis>
class LaneSolver final : public Simulation {
 public:
  LaneSolver(const Scene& scene, const Scheme& scheme, double flip_fraction, int threads)
      : stepping_(scheme.stepping), passes_(scene, scheme, flip_fraction, threads) {}

  void advance(double t, double dt) override {
    switch (stepping_) {
      case Scheme::Stepping::Usl:
        return step_usl(passes_, t, dt);
      case Scheme::Stepping::Musl:
        return step_musl(passes_, t, dt);
      default:
        return step_usf(passes_, t, dt);
    }
  }

  [[nodiscard]] std::optional<std::string> breakdown() const override { return passes_.breakdown(); }
  [[nodiscard]] const Particles& particles() const override { return passes_.particles(); }

  [[nodiscard]] VectorField grid_field(const VectorField& points, double t) const override {
    return field_at<Basis>(passes_.grid(), passes_.mapped_velocity(t), points);
  }

  [[nodiscard]] std::vector<Mat2> grid_gradient(const VectorField& points, double t) const override {
    return gradient_at<Basis>(passes_.grid(), passes_.mapped_velocity(t), points);
  }

  [[nodiscard]] Totals totals() const override { return totals_of(passes_.particles(), passes_.impulse()); }

 private:
  Scheme::Stepping stepping_;
  LanePasses<Basis> passes_;
};

}  // namespace mpm
