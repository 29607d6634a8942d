#pragma once

#include <Eigen/SparseCholesky>
#include <optional>

#include "solver/incompressible/space/velocity_space.hpp"

namespace mpm::incompressible {

/// Solves A w = load over the coordinates w of solenoidal velocities (VelocitySpace::solenoidal_basis), A
/// symmetric and positive definite, of forms with constant coefficients. Beside walls by Cholesky's factor;
/// where no side is a wall every place is like the next, A is circulant along both axes, and the real Fourier
/// modes diagonalise it (Davis, Circulant Matrices, 1979): four dense products a solve, and no factor.
class SolenoidalFactor {
 public:
  /// @throws SceneError where A is not positive definite.
  SolenoidalFactor(const VelocitySpace& space, const SparseMatrix& matrix);

  [[nodiscard]] VectorXd solve(const VectorXd& load) const;

 private:
  /// The stream function, of which the last coefficient is no coordinate, then two uniform velocities.
  struct Fourier {
    MatrixXd modes_x, modes_y;  ///< orthonormal, a mode a column
    MatrixXd inverse;           ///< 1/eigenvalue by mode along x, y; 0 for the constant
    Vec2 uniform;               ///< A of the uniform velocities
  };
  static Fourier fourier(const VelocitySpace& space, const SparseMatrix& matrix);
  static VectorXd solve(const Fourier& fourier, const VectorXd& load);

  std::optional<Fourier> fourier_;
  Eigen::SimplicialLLT<SparseMatrix> cholesky_;
};

}  // namespace mpm::incompressible
