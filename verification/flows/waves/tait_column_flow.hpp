#pragma once

#include "reference/compressible/tait_column.hpp"
#include "verification/flows/flow.hpp"

namespace verification {

/// A column of fluid at rest under gravity between two plates, from its hydrostatic equilibrium: nothing may
/// happen. Velocities are relative to the speed of sound, so a velocity error is the noise that the scheme
/// makes.
struct TaitColumnFlowParameters {
  double height = 0;            ///< H [m]
  int axis = 1;                 ///< that gravity points against, 0 for x, 1 for y
  double density_contrast = 0;  ///< (density at the bottom)/(density at the top) - 1; the top has rho0
  mpm::Fluid fluid;
};

class TaitColumnFlow final : public Flow {
 public:
  explicit TaitColumnFlow(const TaitColumnFlowParameters& parameters);
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  [[nodiscard]] double velocity_scale() const override { return parameters_.fluid.sound_speed(); }
  /// The pressure at the bottom; that at the top is zero.
  [[nodiscard]] double pressure_scale() const override { return solution_->pressure(0); }
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return parameters_.axis; }
  [[nodiscard]] double length() const override { return parameters_.height; }

 private:
  TaitColumnFlowParameters parameters_;
  double gravity_;  // [m/s2]
  std::shared_ptr<const reference::TaitColumn> solution_;
};

}  // namespace verification
