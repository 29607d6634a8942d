#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "solver/grid/grid.hpp"

namespace mpm {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Square matrix of zeros with an entry for every pair of functions that share a cell. With `components` > 1
/// every node carries that many unknowns: number components * node + c.
SparseMatrix pair_pattern(const Grid& grid, int components);

/// Where the entries of a pair_pattern() stand in its array of values, without a search: pairs of functions
/// in a particle's stencil are known by their distance along each axis.
class PairSlots {
 public:
  PairSlots(const Grid& grid, const SparseMatrix& pattern, int components);

  /// Number of the distance from the k-th to the l-th node of a stencil with `support_x` nodes along x.
  [[nodiscard]] std::vector<int> distances(int width, int support_x) const;
  /// Position of the entry in row components * row_node, column components * column_node + b, where the
  /// column's node is at the given distance from the row's; further components of the row follow it.
  [[nodiscard]] std::size_t position(int row_node, int distance, int b) const {
    return slot_[static_cast<std::size_t>((row_node * reach_ * reach_ + distance) * components_ + b)];
  }

 private:
  int degree_, reach_, components_;
  std::vector<std::size_t> slot_;
};

/// A function whose diagonal entry of a mass matrix is below this fraction of the largest holds at most the
/// corner of one particle: its value would be a quotient of two near zeros, so it is left out.
inline constexpr double negligible_mass = 1e-6;

/// Makes a symmetric matrix leave the marked unknowns alone: their rows and columns become `diagonal` times
/// those of the identity.
void decouple(SparseMatrix& matrix, const std::vector<char>& marked, double diagonal);

/// A nodal field as a matrix of one row a node.
using FieldRows = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>>;
FieldRows rows_of(VectorField& field);
using ConstFieldRows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>>;
ConstFieldRows rows_of(const VectorField& field);

}  // namespace mpm
