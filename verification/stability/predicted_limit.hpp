#pragma once

#include <optional>

#include "verification/stability/amplification.hpp"

namespace verification {

/// Where the particles may stand while the step is to be stable: in their seats, or anywhere that a stream
/// along x, y, or both may carry them.
enum class Motion { Rest, AlongX, AlongY, Any };

/// What is asked: a scheme, a lattice, waves, and a ray from the origin of the (r, CFL) plane. Along a ray dt
/// grows in one fluid on one grid. Units of the ray: a limit is given in multiples of `ray`.
struct StabilityProblem {
  mpm::Scheme scheme;
  ParticleLattice lattice;
  Waves waves = Waves::Shear;
  StepSize ray{1, 0};

  [[nodiscard]] StepSize at(double multiple) const { return {ray.r * multiple, ray.cfl * multiple}; }
};

/// First loss of stability along the ray.
struct PredictedLimit {
  std::optional<double> multiple;      ///< of the ray; none when stable up to the largest tried
  std::array<double, 2> theta{0, 0};   ///< the wave that grows first [rad a cell]
  std::array<double, 2> offset{0, 0};  ///< where the particles then stand [cells]
};

/// Largest stable multiple of the ray, not above `largest`: that at which the spectral radius of the
/// amplification matrix exceeds one for some wavenumber and some offset. All wavenumbers and offsets are
/// scanned, then the least stable point is refined. The interior of a uniform lattice: walls are not
/// included.
PredictedLimit predict_limit(const StabilityProblem& problem, Motion motion, double largest);

/// Smallest multiple, not above `largest`, at which one wave grows on particles at one offset.
double wave_limit(const StabilityProblem& problem, const std::array<double, 2>& theta,
                  const std::array<double, 2>& offset, double largest);

}  // namespace verification
