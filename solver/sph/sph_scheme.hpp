#pragma once

#include <string>

#include "solver/scene/scheme.hpp"

namespace mpm {

/// How smoothed particle hydrodynamics simulates a scene: its choices stand to SphSolver as Scheme does to
/// the material point method. Names are those of the literature and of the TOML files.
struct SphScheme {
  /// Quintic spline (support of three smoothing lengths) or cubic spline (two).
  enum class Kernel { Quintic, Cubic };
  /// Density from the divergence of the velocity, or as the sum of the neighbours' masses under the kernel.
  enum class Density { Continuity, Summation };
  /// Mirror: images of the fluid with the velocity reflected in the wall's. Morris: fixed particles whose
  /// velocity each fluid particle extrapolates through the wall, limited near it (Morris, Fox & Zhu 1997).
  enum class Wall { Mirror, Morris };
  Kernel kernel = Kernel::Quintic;
  double smoothing = 0;  ///< smoothing length over the spacing of the particles; 0: the kernel's own default
  Density density = Density::Continuity;
  Wall wall = Wall::Mirror;
  double wall_limit = 1.5;  ///< Morris: largest factor of extrapolation

  /// Smoothing length over spacing: as given, else 1 for the quintic and 1.3 for the cubic kernel.
  [[nodiscard]] double smoothing_ratio() const {
    return smoothing > 0 ? smoothing : kernel == Kernel::Quintic ? 1.0 : 1.3;
  }

  /// Throws SceneError for a smoothing length or a limit out of range.
  void validate() const;
};

/// Orders for a lattice of particles that flow along their rows: kernel and mirror images are symmetric,
/// order 2 in the spacing at a fixed ratio of smoothing; an extrapolation that is limited beside the wall
/// leaves order 1 (Morris, Fox & Zhu 1997, section 3.7). Velocity Verlet is of order 2, nothing is lost by
/// remapping.
FormalOrder formal_order(const SphScheme& scheme);

/// Name of a part, e.g. "quintic"; and back (throws SceneError listing the known names).
std::string name(SphScheme::Kernel kernel);
std::string name(SphScheme::Density density);
std::string name(SphScheme::Wall wall);
SphScheme::Kernel sph_kernel_named(const std::string& text);
SphScheme::Density sph_density_named(const std::string& text);
SphScheme::Wall sph_wall_named(const std::string& text);

}  // namespace mpm
