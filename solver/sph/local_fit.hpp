#pragma once

#include "solver/linear_algebra.hpp"
#include "solver/sph/pairs/entries.hpp"
#include "solver/sph/pairs/entry_rows.hpp"
#include "solver/sph/smoothing_kernel.hpp"

namespace mpm::sph {

/// A velocity field near a point: the quadratic polynomial that fits the entries around it best, weighted by
/// the kernel (moving least squares; Lancaster & Salkauskas 1981). Where the entries do not determine it, a
/// linear one, or their weighted mean.
struct LocalFit {
  Vec2 velocity;  ///< [m/s]; NaN where no entry is near
  Mat2 gradient;  ///< L_ab = d v_a/d x_b [1/s]
};

/// `reach` [m]: the kernel's, and how far entries have moved since their rows were built. Those that belong
/// to walls take part if asked for.
LocalFit fit_at(const Vec2& point, const Entries& entries, const EntryRows& rows, double reach,
                bool with_walls, const SmoothingKernel& kernel);

}  // namespace mpm::sph
