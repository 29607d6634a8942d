#pragma once

#include <Eigen/SparseCholesky>

#include "solver/incompressible/space/velocity_space.hpp"

namespace mpm::incompressible {

/// The pressure in S_{k-1} x S_{k-1} that binds the velocities of a space: no step needs it, as it is
/// orthogonal to solenoidal velocities; it is what is left of the forces on all the others.
class Pressure {
 public:
  explicit Pressure(const VelocitySpace& space);

  /// Coefficients over all functions, rows along x [m2/s2], of the p of mean zero with integral of p div N_i
  /// = load_i [m3/s2] for every velocity; where there is no such p, nearest to it.
  [[nodiscard]] MatrixXd balancing(const VectorXd& load) const;
  [[nodiscard]] double value(const MatrixXd& coefficients, const Vec2& x) const;

 private:
  using Factor = Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>>;

  const VelocitySpace& space_;
  SparseMatrix divergence_;
  Eigen::SimplicialLDLT<SparseMatrix> of_divergences_;  // D D^T
  std::array<Factor, 2> mass_;                          // of an axis
};

}  // namespace mpm::incompressible
