#pragma once

#include "reference/vortices/walled_vortex.hpp"
#include "verification/flows/flow.hpp"

namespace verification {

/// The manufactured vortex between four walls of reference/vortices/walled_vortex.hpp, decaying or steady.
/// Errors are relative to the exact field's root mean square at their own time.
class WalledVortexFlow final : public Flow {
 public:
  /// Throws std::invalid_argument as the reference does.
  WalledVortexFlow(const reference::WalledVortexParameters& parameters, const mpm::Fluid& fluid);
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  [[nodiscard]] double velocity_scale() const override { return solution_->rms_speed(0); }
  [[nodiscard]] double velocity_scale_at(double t) const override { return solution_->rms_speed(t); }
  [[nodiscard]] double pressure_scale() const override {
    return 0.5 * fluid_.density * parameters_.amplitude * parameters_.amplitude;
  }
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return 1; }
  [[nodiscard]] double length() const override { return parameters_.side; }

 private:
  reference::WalledVortexParameters parameters_;
  mpm::Fluid fluid_;
  std::shared_ptr<const reference::WalledVortex> solution_;
};

}  // namespace verification
