#pragma once

#include <string>
#include <vector>

namespace mpm {

/// How a scene is simulated: one choice of each part. Names are those of the literature and of the TOML
/// files.
struct Scheme {
  enum class Basis { Linear, Quadratic, Cubic };
  enum class Transfer { Flip, Pic, FlipBlend, Apic, FullMass };
  enum class Stepping { Usf, Usl, Musl, Leapfrog, ImplicitEuler, ImplicitSdirk2 };
  /// What the density of a particle follows: the dilatation at its place, or that of its cell, whose
  /// particles then share one density (solver/material/cell_dilatation.hpp).
  enum class Dilatation { Particle, Cell };
  Basis basis = Basis::Linear;
  Transfer transfer = Transfer::Flip;
  Stepping stepping = Stepping::Usf;
  Dilatation dilatation = Dilatation::Particle;
  double flip_fraction = 0.95;  ///< FlipBlend only: 1 is FLIP, 0 is PIC
  /// Particles return to their lattice (solver/transfer/particle_reset.hpp) after this many steps; 0: never.
  int reset_every = 0;
  /// The same once the fluid has been strained by this much since the last time, integral of sqrt(2 D:D) dt
  /// where that is largest; 0: never. Unlike a number of steps it does not change with dt.
  double reset_strain = 0;

  [[nodiscard]] bool resets() const { return reset_every > 0 || reset_strain > 0; }

  /// Throws SceneError for a fraction outside [0, 1], a negative or infinite reset, or a dilatation of cells
  /// beside particles that carry their own gradient (full mass in steps of second order).
  void validate() const;
};

/// A part of a scheme as the report presents it.
struct SchemePart {
  std::string name;         ///< in TOML files, e.g. "linear"
  std::string description;  ///< one line
};

/// Every basis, transfer, stepping and dilatation in the order of their enumerations.
const std::vector<SchemePart>& basis_parts();
const std::vector<SchemePart>& transfer_parts();
const std::vector<SchemePart>& stepping_parts();
const std::vector<SchemePart>& dilatation_parts();

/// Name of a scheme's part, e.g. "linear"; and back (throws SceneError listing the known names).
std::string name(Scheme::Basis basis);
std::string name(Scheme::Transfer transfer);
std::string name(Scheme::Stepping stepping);
std::string name(Scheme::Dilatation dilatation);
/// When a scheme resets its particles: "never", "every 25 steps", "every strain of 0.5", or both joined by
/// "or".
std::string reset_name(const Scheme& scheme);
Scheme::Basis basis_named(const std::string& text);
Scheme::Transfer transfer_named(const std::string& text);
Scheme::Stepping stepping_named(const std::string& text);
Scheme::Dilatation dilatation_named(const std::string& text);

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
/// points a cell across, and 2 with evenly spaced rows.
FormalOrder formal_order(const Scheme& scheme);

}  // namespace mpm
