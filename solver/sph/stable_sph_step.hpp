#pragma once

#include "solver/scene/scene.hpp"
#include "solver/sph/smoothing_kernel.hpp"
#include "solver/step/stable_step.hpp"
#include "solver/step/time_step.hpp"

namespace mpm {

/// Distance of neighbouring particles along an axis [m].
double particle_spacing(const Scene& scene, int axis);

/// Smoothing length of a scheme on a scene's lattice [m].
double smoothing_length(const SphScheme& scheme, const Scene& scene);

/// Largest stable step of SPH in units of the smallest cell, away from walls, for every wave on a lattice
/// whose rows have slid by any amount: lambda dt <= 1 with the largest rate of decay lambda (viscous), and
/// omega dt
/// <= 2 with the largest frequency of sound (acoustic).
StableStep stable_sph_step(const SphScheme& scheme, const Scene& scene);

/// What Morris, Fox & Zhu (1997) use: dt <= 0.25 h/c, 0.125 h^2/nu and 0.25 sqrt(h/F), with the smoothing
/// length h and the body acceleration F at the start; but no more than half of each limit above.
TimeStepRule sph_time_step(const SphScheme& scheme, const Scene& scene);

/// Throws SceneError where walls are closer to each other than the kernel reaches.
void require_sph_fits(const SphScheme& scheme, const Scene& scene);

namespace sph {

/// Neighbours are listed up to this share of the support beyond it, so that a list lasts some steps.
inline constexpr double skin_share = 0.15;

SmoothingKernel kernel_of(const SphScheme& scheme, const Scene& scene);

}  // namespace sph
}  // namespace mpm
