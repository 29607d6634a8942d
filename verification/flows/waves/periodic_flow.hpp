#pragma once

#include <array>

#include "reference/waves/shear_wave.hpp"
#include "verification/flows/flow.hpp"

namespace verification {

/// Rigid translation through a box that is periodic in both directions, at rest in its own frame: particles
/// cross cells, and nothing else may happen. `cells` count along y, `cells_along` along x.
struct TranslationParameters {
  double length = 0;             ///< of the box along y [m]
  Vec2 velocity = Vec2::Zero();  ///< W [m/s], not zero
  double density_ratio = 1;      ///< rho/rho0 everywhere; other than 1 the fluid is under uniform pressure
  mpm::Fluid fluid;
};

class TranslationFlow final : public Flow {
 public:
  explicit TranslationFlow(const TranslationParameters& parameters) : parameters_(parameters) {}
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  [[nodiscard]] double velocity_scale() const override { return parameters_.velocity.norm(); }
  [[nodiscard]] double pressure_scale() const override;
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return 1; }
  [[nodiscard]] double length() const override { return parameters_.length; }

 private:
  TranslationParameters parameters_;
};

/// A decaying shear wave oblique to the grid, in a square periodic box that holds a whole number of waves
/// along each side, carried by a uniform stream. `cells` count along both sides.
struct ObliqueWaveParameters {
  double length = 0;               ///< side of the box [m]
  std::array<int, 2> waves{};      ///< along x and y, not both zero
  double amplitude = 0;            ///< U [m/s]
  Vec2 stream = Vec2::Zero();      ///< W [m/s]
  double kinematic_viscosity = 0;  ///< nu [m2/s]
  mpm::Fluid fluid;
};

class ObliqueWaveFlow final : public Flow {
 public:
  explicit ObliqueWaveFlow(const ObliqueWaveParameters& parameters);
  /// Throws mpm::SceneError when cells_along is given: the box is square.
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  [[nodiscard]] double velocity_scale() const override { return parameters_.amplitude; }
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return parameters_.waves[1] != 0 ? 1 : 0; }
  [[nodiscard]] double length() const override { return parameters_.length; }

 private:
  ObliqueWaveParameters parameters_;
  std::shared_ptr<const reference::ShearWave> solution_;
};

}  // namespace verification
