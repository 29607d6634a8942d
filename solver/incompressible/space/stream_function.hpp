#pragma once

#include "solver/incompressible/space/velocity_space.hpp"

namespace mpm::incompressible {

/// The coordinates w of solenoidal velocities (columns of VelocitySpace::solenoidal_basis) as a stream
/// function psi in S_k x S_k, u = d psi/dy, v = -d psi/dx, up to a uniform velocity where no side is a wall.
class StreamFunction {
 public:
  explicit StreamFunction(const VelocitySpace& space);

  /// Coefficients of all functions, rows along x, columns along y [m2/s].
  [[nodiscard]] MatrixXd extended(const VectorXd& w) const;
  /// Sums over the functions of every coordinate; `size` coordinates.
  [[nodiscard]] VectorXd folded(const MatrixXd& functions, Eigen::Index size) const;

  /// Coordinate of a function, or -1 where it is zero, and the sign with which it enters.
  struct Share {
    int coordinate = -1;
    double sign = 1;
  };
  [[nodiscard]] Share share(int i, int j) const {
    return shares_[static_cast<std::size_t>(i + j * static_cast<int>(rows_))];
  }

 private:
  Eigen::Index rows_, columns_;
  std::vector<Share> shares_;
};

}  // namespace mpm::incompressible
