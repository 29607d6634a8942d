#pragma once

#include "reference/surface/gravity_wave.hpp"
#include "verification/flows/flow.hpp"

namespace verification {

/// A small standing gravity wave in a tank one wavelength long, along whose sides the fluid slips. The
/// surface is level at t = 0 and moves with amplitude cos(k x).
struct StandingWaveFlowParameters {
  double wavelength = 0;           ///< [m]
  double depth = 0;                ///< of the fluid [m]
  double height = 0;               ///< of the tank [m]
  double gravity = 0;              ///< [m/s2]
  double amplitude = 0;            ///< of the surface's velocity [m/s]
  double kinematic_viscosity = 0;  ///< [m2/s]
  mpm::Fluid fluid;
};

class StandingWaveFlow final : public Flow {
 public:
  explicit StandingWaveFlow(const StandingWaveFlowParameters& parameters);
  /// Cells are counted along the wave.
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  /// Of the fluid only, not of the grid above it.
  [[nodiscard]] bool has_exact() const override { return false; }
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>&) const override {
    return nullptr;
  }
  [[nodiscard]] std::optional<Oscillation> oscillation() const override;
  [[nodiscard]] double velocity_scale() const override { return parameters_.amplitude; }
  /// At a side, half way down, where the fluid moves up and down.
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return 0; }
  [[nodiscard]] double length() const override { return parameters_.wavelength; }

 private:
  StandingWaveFlowParameters parameters_;
  reference::GravityWave wave_;
};

}  // namespace verification
