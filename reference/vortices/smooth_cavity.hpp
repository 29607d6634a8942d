#pragma once

#include <array>
#include <vector>

namespace reference {

/// The steady flow in a unit square, y = 1 of which moves along x with 16 x^2 (1 - x)^2 ("regularised
/// cavity": Shen, J. Comput. Phys. 95 (1991) 228), so that velocity and its gradient are continuous in the
/// corners. Newtonian fluid, in units of the side L and the lid's largest velocity U, Re = U L/nu.
///
/// Galerkin's method for the stream function, u = psi_y, v = -psi_x,
///   nu (lap psi, lap phi) + (lap psi, psi_y phi_x - psi_x phi_y) = 0 for all phi,
/// psi = 16 x^2 (1 - x)^2 y^2 (y - 1) + sum a_ij phi_i(x) phi_j(y) with the combinations of Legendre
/// polynomials that vanish with their slopes at both ends (Shen, SIAM J. Sci. Comput. 15 (1994) 1489);
/// Newton's method. What is left is the corners': psi ~ r^3.74 there (Moffatt 1964), so coefficients fall
/// algebraically, fast.
class SmoothCavity {
 public:
  /// `functions` along each axis, at least 4. Throws std::invalid_argument for a Reynolds number that is not
  /// positive and std::runtime_error where Newton's method does not converge.
  SmoothCavity(double reynolds, int functions);

  /// Velocity at a point of the unit square.
  [[nodiscard]] std::array<double, 2> velocity(double x, double y) const;

 private:
  int functions_;
  std::vector<double> coefficients_;  // a_ij, i fastest
};

}  // namespace reference
