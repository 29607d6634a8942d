#pragma once

#include "solver/linear_algebra.hpp"
#include "solver/sph/neighbour_list.hpp"
#include "solver/sph/smoothing_kernel.hpp"

namespace mpm::sph {

/// A velocity field near a point: the quadratic polynomial that fits the entries around it best, weighted by
/// the kernel (moving least squares; Lancaster & Salkauskas 1981). Where the entries do not determine it, a
/// linear one, or their weighted mean.
struct LocalFit {
  Vec2 velocity;  ///< [m/s]; NaN where no entry is near
  Mat2 gradient;  ///< L_ab = d v_a/d x_b [1/s]
};

/// Only the entries in [0, end) take part.
LocalFit fit_at(const Vec2& point, const std::vector<Neighbour>& entries, std::size_t end,
                const NeighbourList& list, const SmoothingKernel& kernel);

}  // namespace mpm::sph
