#pragma once

#include <Eigen/Core>
#include <array>

#include "reference/cavity/cavity_viscosity.hpp"
#include "reference/cavity/spline_axis.hpp"

namespace reference {

/// The steady flow of a generalised Newtonian fluid in a unit square whose lid, y = 1, moves with unit
/// velocity along x, by Galerkin's method for the stream function, u = psi_y, v = -psi_x:
///   integral of nu(q) [4 psi_xy phi_xy + (psi_yy - psi_xx)(phi_yy - phi_xx)] + lap psi (psi_y phi_x -
///   psi_x phi_y) = 0 for all phi,   q = 4 psi_xy^2 + (psi_yy - psi_xx)^2 = 2 D:D,
/// among products of splines on spans that cluster at the walls; psi = psi_n = 0 on walls, psi_y = 1 on the
/// lid but for the two spans next to each corner, which carry the jump. Gauss points, degree + 1 a span and
/// axis; Newton's method. Velocities are continuous to the degree - 2nd derivative.
///
/// What the jump's span of width d costs elsewhere falls with d^2.74 for a Newtonian fluid: the flow around
/// the corner answers with the eigenfunction psi ~ r^-1.74 (Moffatt, J. Fluid Mech. 18 (1964) 1).
class CavityStreamFunction {
 public:
  struct Mesh {
    int spans = 32;           ///< along each axis
    int degree = 4;           ///< of the stream function
    double clustering = 3.0;  ///< g of clustered_breaks()
  };
  /// Starts from another solution (of another mesh or a fluid not too different) where one is given, else
  /// from rest. Throws std::invalid_argument for fewer than 4 spans and std::runtime_error where Newton's
  /// method does not converge.
  CavityStreamFunction(const CavityViscosity& viscosity, const Mesh& mesh,
                       const CavityStreamFunction* start = nullptr);

  /// Of a point in the unit square [U L]; 0 on the walls.
  [[nodiscard]] double stream(double x, double y) const;
  /// u, v [U].
  [[nodiscard]] std::array<double, 2> velocity(double x, double y) const;
  [[nodiscard]] int iterations() const { return iterations_; }

 private:
  SplineAxis axis_;
  Eigen::MatrixXd coefficients_;  // along x in rows, y in columns
  int iterations_ = 0;
};

}  // namespace reference
