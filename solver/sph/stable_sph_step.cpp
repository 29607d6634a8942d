#include "solver/sph/stable_sph_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mpm {
namespace {

/// Symbols of the Laplacian and of the gradient on a lattice, at a wave vector [1/m].
struct Symbols {
  double laplacian, gradient;
};

Symbols symbols_at(const sph::SmoothingKernel& kernel, const Vec2& spacing, double slide, const Vec2& wave) {
  const int far_x = 2 + static_cast<int>(kernel.radius / spacing.x());
  const int far_y = 1 + static_cast<int>(kernel.radius / spacing.y());
  double laplacian = 0;
  Vec2 gradient = Vec2::Zero();
  for (int j = -far_y; j <= far_y; ++j)
    for (int i = -far_x; i <= far_x; ++i) {
      const Vec2 d((i + (j % 2 == 0 ? 0.0 : slide)) * spacing.x(), j * spacing.y());
      const double volume_f = spacing.x() * spacing.y() * kernel.gradient(d.squaredNorm());
      const double phase = wave.dot(d);
      laplacian -= 2 * volume_f * (1 - std::cos(phase));
      gradient += volume_f * std::sin(phase) * d;
    }
  return {laplacian, gradient.norm()};
}

}  // namespace

double particle_spacing(const Scene& scene, int axis) {
  return scene.cell_size(axis) / scene.particles_per_cell[static_cast<std::size_t>(axis)];
}

double smoothing_length(const SphScheme& scheme, const Scene& scene) {
  return scheme.smoothing_ratio() * std::sqrt(particle_spacing(scene, 0) * particle_spacing(scene, 1));
}

StableStep stable_sph_step(const SphScheme& scheme, const Scene& scene) {
  constexpr int waves = 16, slides = 4;
  const sph::SmoothingKernel kernel = sph::kernel_of(scheme, scene);
  const Vec2 spacing(particle_spacing(scene, 0), particle_spacing(scene, 1));
  Symbols worst{0, 0};
  for (int slide = 0; slide < slides; ++slide)
    for (int j = 0; j <= waves; ++j)
      for (int i = 0; i <= waves; ++i) {
        const Vec2 wave(std::numbers::pi * i / (waves * spacing.x()),
                        std::numbers::pi * j / (waves * spacing.y()));
        const Symbols here = symbols_at(kernel, spacing, static_cast<double>(slide) / slides, wave);
        worst.laplacian = std::max(worst.laplacian, here.laplacian);
        worst.gradient = std::max(worst.gradient, here.gradient);
      }
  const double cell = scene.smallest_cell_size();
  return {1 / (worst.laplacian * cell * cell), 2 / (worst.gradient * cell)};
}

TimeStepRule sph_time_step(const SphScheme& scheme, const Scene& scene) {
  const StableStep limit = stable_sph_step(scheme, scene);
  const double cell = scene.smallest_cell_size(), h = smoothing_length(scheme, scene);
  TimeStepRule rule;
  rule.cfl_acoustic = std::min(0.25 * h / cell, 0.5 * limit.acoustic);
  rule.cfl_viscous = std::min(0.125 * h * h / (cell * cell), 0.5 * limit.viscous);
  const double force = scene.body_acceleration ? scene.body_acceleration(scene.start).norm() : 0;
  const double c = scene.fluid.sound_speed(), nu = scene.fluid.largest_kinematic_viscosity();
  if (force > 0) {  // a bound on dt in terms of the two that the rule knows
    const double longest = 0.25 * std::sqrt(h / force);
    if (c > 0) rule.cfl_acoustic = std::min(rule.cfl_acoustic, longest * c / cell);
    if (nu > 0) rule.cfl_viscous = std::min(rule.cfl_viscous, longest * nu / (cell * cell));
  }
  return rule;
}

void require_sph_fits(const SphScheme& scheme, const Scene& scene) {
  const double reach =
      (1 + sph::skin_share) * sph::profile_of(scheme.kernel).support * smoothing_length(scheme, scene);
  for (const int axis : {0, 1})
    if (!scene.periodic(axis) && scene.size[axis] < reach)
      throw SceneError(
          "walls are closer to each other than the SPH kernel reaches: more cells, or a smaller "
          "scheme.smoothing");
}

namespace sph {

SmoothingKernel kernel_of(const SphScheme& scheme, const Scene& scene) {
  return {scheme.kernel, smoothing_length(scheme, scene), particle_spacing(scene, 0),
          particle_spacing(scene, 1)};
}

}  // namespace sph
}  // namespace mpm
