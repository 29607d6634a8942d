#pragma once

#include "reference/waves/acoustic_wave.hpp"
#include "reference/waves/shear_wave.hpp"
#include "verification/flows/flow.hpp"

namespace verification {

/// What both waves share: one wavelength in a box that is periodic in both directions, varying along one
/// axis.
struct WaveParameters {
  double wavelength = 0;           ///< [m]
  double amplitude = 0;            ///< U [m/s]
  int axis = 0;                    ///< direction that the wave varies in, 0 for x, 1 for y
  Vec2 stream = Vec2::Zero();      ///< uniform velocity of the whole fluid [m/s] (shear wave)
  double kinematic_viscosity = 0;  ///< nu [m2/s]
  mpm::Fluid fluid;
};

/// Square cells, one wavelength across, `cells_along` the other way.
mpm::Scene periodic_box(const WaveParameters& parameters, const Discretisation& discretisation);

/// The velocity and the paths of a shear wave.
std::shared_ptr<const ExactField> shear_wave_field(std::shared_ptr<const reference::ShearWave> wave);

/// Damped standing sound wave u = U sin(k x) from uniform density: equation of state, density update, -2/3 mu
/// tr(D).
class AcousticWaveFlow final : public Flow {
 public:
  explicit AcousticWaveFlow(const WaveParameters& parameters);
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  [[nodiscard]] double velocity_scale() const override { return parameters_.amplitude; }
  /// rho0 c U, the pressure that goes with U in a sound wave.
  [[nodiscard]] double pressure_scale() const override;
  [[nodiscard]] std::optional<Oscillation> oscillation() const override;
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return parameters_.axis; }
  [[nodiscard]] double length() const override { return parameters_.wavelength; }

 private:
  WaveParameters parameters_;
  std::shared_ptr<const reference::AcousticWave> solution_;
};

/// Decaying transverse shear wave, carried along by a uniform stream: frame invariance and exact
/// conservation.
class ShearWaveFlow final : public Flow {
 public:
  explicit ShearWaveFlow(const WaveParameters& parameters);
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  [[nodiscard]] double velocity_scale() const override { return parameters_.amplitude; }
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return parameters_.axis; }
  [[nodiscard]] double length() const override { return parameters_.wavelength; }

 private:
  WaveParameters parameters_;
  std::shared_ptr<const reference::ShearWave> solution_;
};

}  // namespace verification
