#pragma once

#include <Eigen/SparseCholesky>
#include <optional>

#include "solver/incompressible/space/walled_factor.hpp"

namespace mpm::incompressible {

/// Solves A w = load over the coordinates w of solenoidal velocities (VelocitySpace::solenoidal_basis), A the
/// mass, or mass and diffusion, of a uniform fluid. Between four walls by WalledFactor. Where no side is a
/// wall every place is like the next, A is circulant along both axes, and the real Fourier modes diagonalise
/// it (Davis, Circulant Matrices, 1979): four dense products a solve. In channels by Cholesky's factor.
class SolenoidalFactor {
 public:
  /// `matrix` is A; `diffusion` what in it is not mass.
  /// @throws SceneError where A is not positive definite.
  SolenoidalFactor(const VelocitySpace& space, const SparseMatrix& matrix,
                   const std::optional<Diffusion>& diffusion = {});

  [[nodiscard]] VectorXd solve(const VectorXd& load) const;

 private:
  /// The stream function, of which the last coefficient is no coordinate, then two uniform velocities.
  struct Fourier {
    Eigen::Index rows, columns;           ///< coefficients along x, y; the matrices are padded
    MatrixXd modes_x, modes_y;            ///< orthonormal, a mode a column
    MatrixXd transposed_x, transposed_y;  ///< a mode a row
    MatrixXd inverse;                     ///< 1/eigenvalue by mode along x, y; 0 for the constant
    Vec2 uniform;                         ///< A of the uniform velocities
    ModeProducts multiply;
  };
  static Fourier fourier(const VelocitySpace& space, const SparseMatrix& matrix);
  static VectorXd solve(const Fourier& fourier, const VectorXd& load);

  std::optional<Fourier> fourier_;
  std::optional<WalledFactor> walled_;
  Eigen::SimplicialLLT<SparseMatrix> cholesky_;
};

}  // namespace mpm::incompressible
