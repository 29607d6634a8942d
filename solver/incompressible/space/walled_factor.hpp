#pragma once

#include <optional>

#include "solver/incompressible/space/mode_products.hpp"
#include "solver/incompressible/space/velocity_space.hpp"

namespace mpm::incompressible {

/// An area [m2], viscosity times time, times the viscous form; `held` is ViscousForm::held.
struct Diffusion {
  double area;
  std::array<SparseMatrix, 2> held;
};

/// Solves A w = load between four walls, where solenoidal velocities are stream functions psi in S_k x S_k,
/// for mass and diffusion of a uniform fluid: with mass M, stiffness K and bending B of a line (the integrals
/// of N N, N' N' and N'' N'', to which walls add) and E = K + a B,
///   A psi = Mx psi Ey + Ex psi My + 2 a Kx psi Ky.
/// The modes Ex q = lambda Mx q of both lines make the first two diagonal (fast diagonalisation: Lynch, Rice
/// & Thomas, Numer. Math. 6 (1964) 185), which is all where nothing diffuses. The last is no larger than
/// their diffusion and next to diagonal: conjugate gradients on the modes, preconditioned with the diagonal,
/// need 14 iterations of two small dense products at most, whatever mesh and viscosity.
class WalledFactor {
 public:
  /// @throws SceneError where A is not positive definite.
  WalledFactor(const VelocitySpace& space, const std::optional<Diffusion>& diffusion);

  [[nodiscard]] VectorXd solve(const VectorXd& load) const;

 private:
  /// Of a line, padded with zeros.
  struct Modes {
    MatrixXd modes, transposed;  ///< a mode a column, of mass 1; the same by rows
    MatrixXd stiffness;          ///< of modes with each other
    VectorXd eigenvalues;
  };
  static Modes modes(const SplineAxis& axis, const std::optional<Diffusion>& diffusion, int a);

  Eigen::Index rows_, columns_;
  ModeProducts multiply_;
  Modes x_, y_;
  double twice_area_;
  MatrixXd sums_;              // lambda_x + lambda_y
  MatrixXd inverse_diagonal_;  // of A in the modes; zero where there is none
};

}  // namespace mpm::incompressible
