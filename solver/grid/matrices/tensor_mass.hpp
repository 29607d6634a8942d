#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/grid/grid.hpp"

namespace mpm {

/// integral of N_i N_j over an axis [m].
Eigen::MatrixXd mass_along(const Axis& axis);

/// The mass matrix of a fluid of uniform density on a grid of B-splines is a tensor product M_x (x) M_y of
/// two banded matrices, so its inverse costs no more than a few operations a node. Scaled to the diagonal of
/// the true mass matrix it is what conjugate gradients for that matrix are preconditioned with: they need as
/// many iterations as the particles' disorder asks for, whatever the degree of the splines and the number of
/// cells (Gao and Calo, Comput. Methods Appl. Mech. Eng. 274 (2014) 19, for isogeometric mass matrices).
class TensorMass {
 public:
  explicit TensorMass(const Grid& grid);

  /// field <- (M_x (x) M_y)^-1 field, unit density, in place.
  void solve(VectorField& field);

  /// Diagonal entry of M_x (x) M_y at a node [m2].
  [[nodiscard]] double diagonal(std::size_t node) const {
    return x_.diagonal[node % x_.diagonal.size()] * y_.diagonal[node / x_.diagonal.size()];
  }

 private:
  /// Cholesky factor of the mass matrix of one axis, column by column below the diagonal.
  struct Factor {
    explicit Factor(const Axis& axis);
    std::vector<double> diagonal;  // of the matrix [m]
    std::vector<double> inverse_pivot;
    std::vector<int> begin, row;
    std::vector<double> entry;
  };
  /// Solves for every column of a matrix of `width` doubles a row, one row a function of the axis.
  static void solve_rows(const Factor& factor, double* rows, std::size_t width);

  Factor x_, y_;
  VectorField transposed_;
};

}  // namespace mpm
