#pragma once

#include "reference/vortices/manufactured_flow.hpp"
#include "verification/flows/flow.hpp"
#include "verification/flows/fluid_reader.hpp"

namespace verification {

/// The manufactured flow of reference/vortices/manufactured_flow.hpp for any fluid: full shear-rate tensor,
/// advection, moving walls and an acceleration that varies in space and time. Uniform density and pressure:
/// no error of compressibility. Errors are relative to the plate's velocity.
class ManufacturedFlow final : public Flow {
 public:
  /// Throws std::invalid_argument as the reference does.
  ManufacturedFlow(const reference::ManufacturedParameters& parameters, const FluidConfig& fluid);
  /// One wavelength, cells as square as whole numbers allow (`cells_along` plays no part).
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  [[nodiscard]] double velocity_scale() const override { return parameters_.plate_velocity; }
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return 1; }
  [[nodiscard]] double length() const override { return parameters_.height; }

 private:
  reference::ManufacturedParameters parameters_;
  mpm::Fluid fluid_;
  std::shared_ptr<const reference::ManufacturedFlow> solution_;
};

}  // namespace verification
