#pragma once

#include <string>

namespace mpm {

/// How the incompressible material point method simulates a scene (solver/incompressible/): its choices stand
/// to IncompressibleSolver as Scheme does to the weakly compressible method.
struct IncompressibleScheme {
  /// Midpoint: second order, damps nothing. Sdirk2: second order, L-stable, damps what the mesh cannot
  /// follow.
  enum class Stepping { Midpoint, Sdirk2 };
  int degree = 3;  ///< k of the divergence-conforming pair: 2, 3 or 4
  Stepping stepping = Stepping::Midpoint;
  /// Steps after which the particles return to their lattice, at the place where the grid takes their
  /// velocity; 0: never.
  int remap_every = 0;
  /// Share of the mass by which the fit is held to the last field where particles run thin.
  double regularisation = 1e-5;

  /// Throws SceneError for a degree, a remap or a regularisation out of range.
  void validate() const;
};

/// Name of a stepping, "midpoint" or "sdirk2"; and back (throws SceneError listing the known names).
std::string name(IncompressibleScheme::Stepping stepping);
IncompressibleScheme::Stepping incompressible_stepping_named(const std::string& text);

}  // namespace mpm
