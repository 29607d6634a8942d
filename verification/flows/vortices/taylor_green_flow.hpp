#pragma once

#include "reference/vortices/taylor_green.hpp"
#include "verification/flows/flow.hpp"

namespace verification {

struct TaylorGreenFlowParameters {
  double period = 0;               ///< L of the square, periodic box [m]
  double amplitude = 0;            ///< U [m/s]; Re = U L/nu
  double kinematic_viscosity = 0;  ///< nu [m2/s]
  mpm::Fluid fluid;
};

/// One period of the Taylor-Green vortex: advection, pressure and particle disorder. Velocity starts exact,
/// density from the exact pressure through the equation of state, so that next to no sound is set off; what
/// remains of the fluid's compressibility is an error ~ Ma^2 = (U/c)^2. Errors are relative to the exact
/// field's root mean square at their own time, which decays.
class TaylorGreenFlow final : public Flow {
 public:
  explicit TaylorGreenFlow(const TaylorGreenFlowParameters& parameters);
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  [[nodiscard]] double velocity_scale() const override { return solution_->rms_speed(0); }
  [[nodiscard]] double velocity_scale_at(double t) const override { return solution_->rms_speed(t); }
  /// rho0 U^2/2: half of what the pressure spans at t = 0.
  [[nodiscard]] double pressure_scale() const override {
    return 0.5 * parameters_.fluid.density * parameters_.amplitude * parameters_.amplitude;
  }
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return 1; }
  [[nodiscard]] double length() const override { return parameters_.period; }

 private:
  TaylorGreenFlowParameters parameters_;
  std::shared_ptr<const reference::TaylorGreen> solution_;
};

}  // namespace verification
