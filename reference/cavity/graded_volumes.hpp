#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "reference/cavity/cavity_viscosity.hpp"

namespace reference {

/// The steady flow of a generalised Newtonian fluid in a unit square whose lid, y = 1, moves with unit
/// velocity along x, by finite volumes of second order on a staggered mesh (Harlow & Welch 1965) whose lines
/// cluster at the walls: central fluxes of momentum through the volumes of u and v, viscosities 2 nu D at
/// cell centres and corners, walls by one-sided differences over half a cell.
///
/// Fluxes through the faces of a cell cancel, so velocities are differences of a stream function at the
/// corners; sums of the momentum equations around corners are free of pressure. What is solved is those sums
/// for that stream function, by Newton's method: the solution is the one that velocity and pressure would
/// have.
class CavityGradedVolumes {
 public:
  /// n x n cells between the lines x = s - (c/2 pi) sin(2 pi s), s = i/n, and the same along y; n even.
  /// Starts from another mesh's solution, or another fluid's, where one is given. Throws
  /// std::invalid_argument for fewer than 8 cells or an odd number, and std::runtime_error where Newton's
  /// method does not converge.
  CavityGradedVolumes(const CavityViscosity& viscosity, int cells, const CavityGradedVolumes* start = nullptr,
                      double clustering = 0.7);

  /// Stream function and velocity of a point in the unit square, by polynomials through six neighbours along
  /// each axis (sixth order).
  [[nodiscard]] double stream(double x, double y) const;
  [[nodiscard]] std::array<double, 2> velocity(double x, double y) const;
  [[nodiscard]] int iterations() const { return iterations_; }

 private:
  int cells_;
  std::vector<double> lines_;  // n + 1
  Eigen::MatrixXd stream_;     // at corners, x along rows, (n + 1) x (n + 1)
  int iterations_ = 0;
};

}  // namespace reference
