#pragma once

#include <string>
#include <vector>

namespace mpm {

/// How smoothed particle hydrodynamics simulates a scene (solver/sph/).
struct SphScheme {
  enum class Kernel { Quintic, Cubic };
  /// Density from the divergence of the velocity, or from the particles' distances.
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
};

/// How a scene is simulated: one choice of each part. Names are those of the literature and of the TOML
/// files.
struct Scheme {
  enum class Method { Mpm, Sph };
  enum class Basis { Linear, Quadratic, Cubic };
  enum class Transfer { Flip, Pic, FlipBlend, Apic, FullMass };
  enum class Stepping { Usf, Usl, Musl, Leapfrog, ImplicitEuler, ImplicitSdirk2 };
  Basis basis = Basis::Linear;
  Transfer transfer = Transfer::Flip;
  Stepping stepping = Stepping::Usf;
  double flip_fraction = 0.95;  ///< FlipBlend only: 1 is FLIP, 0 is PIC
  /// Particles return to their lattice (solver/transfer/particle_reset.hpp) after this many steps; 0: never.
  int reset_every = 0;
  /// The same once the fluid has been strained by this much since the last time, integral of sqrt(2 D:D) dt
  /// where that is largest; 0: never. Unlike a number of steps it does not change with dt.
  double reset_strain = 0;
  Method method = Method::Mpm;
  SphScheme sph;  ///< of that method; what stands above is of the material point method

  [[nodiscard]] bool resets() const { return reset_every > 0 || reset_strain > 0; }

  /// Throws SceneError for a fraction outside [0, 1], or a negative or infinite reset.
  void validate() const;
};

/// A part of a scheme as the report presents it.
struct SchemePart {
  std::string name;         ///< in TOML files, e.g. "linear"
  std::string description;  ///< one line
};

/// Every method, part of SPH, basis, transfer and stepping in the order of their enumerations.
const std::vector<SchemePart>& method_parts();
const std::vector<SchemePart>& sph_kernel_parts();
const std::vector<SchemePart>& sph_density_parts();
const std::vector<SchemePart>& sph_wall_parts();
const std::vector<SchemePart>& basis_parts();
const std::vector<SchemePart>& transfer_parts();
const std::vector<SchemePart>& stepping_parts();

/// Name of a scheme's part, e.g. "linear"; and back (throws SceneError listing the known names).
std::string name(Scheme::Method method);
std::string name(SphScheme::Kernel kernel);
std::string name(SphScheme::Density density);
std::string name(SphScheme::Wall wall);
std::string name(Scheme::Basis basis);
std::string name(Scheme::Transfer transfer);
std::string name(Scheme::Stepping stepping);
/// When a scheme resets its particles: "never", "every 25 steps", "every strain of 0.5", or both joined by
/// "or".
std::string reset_name(const Scheme& scheme);
Scheme::Method method_named(const std::string& text);
SphScheme::Kernel sph_kernel_named(const std::string& text);
SphScheme::Density sph_density_named(const std::string& text);
SphScheme::Wall sph_wall_named(const std::string& text);
Scheme::Basis basis_named(const std::string& text);
Scheme::Transfer transfer_named(const std::string& text);
Scheme::Stepping stepping_named(const std::string& text);

/// Powers of h and dt that theory gives the error of a scheme, for a smooth shear flow along frozen particle
/// rows.
struct FormalOrder {
  double space;            ///< of the grid field at a step that makes the time error negligible
  double space_particles;  ///< of the particles' own velocities, L2
  /// Of the difference of successive dt on one mesh. In flows that mix particles, lumped FLIP drifts with a
  /// smoothed velocity, which leaves an error O(h^2 dt) beside this.
  double time;
  /// Remapping loses energy at a rate ~ h^remap_space/dt: below some dt the error *grows* as dt shrinks, and
  /// `space` and `time` hold only above it. 0: no such loss.
  double remap_space;
};

/// Orders of a scheme. Full mass reaches degree + 1 in space with Gauss rows (seeding) of at least `degree`
/// points a cell across, and 2 with evenly spaced rows. SPH: 2 between mirrors on a lattice that only slides,
/// 1 beside fixed wall particles, whose limited extrapolation misplaces the wall by a part of the spacing.
FormalOrder formal_order(const Scheme& scheme);

}  // namespace mpm
