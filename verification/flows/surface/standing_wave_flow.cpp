#include "verification/flows/surface/standing_wave_flow.hpp"

#include <limits>
#include <numbers>

#include "verification/flows/surface/column_at_rest.hpp"

namespace verification {

StandingWaveFlow::StandingWaveFlow(const StandingWaveFlowParameters& p)
    : parameters_(p),
      wave_({2 * std::numbers::pi / p.wavelength, p.depth, p.gravity, p.kinematic_viscosity}) {}

mpm::Scene StandingWaveFlow::scene(const Discretisation& d) const {
  const StandingWaveFlowParameters& p = parameters_;
  mpm::Scene scene;
  scene.size = {p.wavelength, p.height};
  scene.cells = {d.cells, d.cells_along};
  scene.particles_per_cell = {d.particles_across, d.particles_along};
  for (mpm::Side& side : scene.sides)
    side = mpm::Side::wall(Vec2::Zero(), std::numeric_limits<double>::infinity());
  scene.fluid = p.fluid;
  scene.body_acceleration = [g = p.gravity](double) { return Vec2(0, -g); };
  scene.free_surface = mpm::FreeSurface{[depth = p.depth](const Vec2& x) { return x.y() < depth; }};
  scene.initial_density =
      density_at_rest({p.depth, p.gravity, scene.cell_size(1), d.particles_along}, p.fluid);
  scene.initial_velocity = [wave = wave_, amplitude = p.amplitude](const Vec2& x) {
    const reference::GravityWave::Velocity v = wave.velocity(amplitude, x.x(), x.y(), 0);
    return Vec2(v.u, v.v);
  };
  return scene;
}

std::optional<Oscillation> StandingWaveFlow::oscillation() const {
  return Oscillation{wave_.rate().imag(), -wave_.rate().real()};
}

Probe StandingWaveFlow::probe() const {
  return {{0, 0.5 * parameters_.depth}, {0, 1}};
}

}  // namespace verification
