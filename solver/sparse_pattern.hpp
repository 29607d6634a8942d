#pragma once

#include <Eigen/SparseCore>

#include "solver/grid.hpp"

namespace mpm {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Square matrix of zeros with an entry for every pair of functions that share a cell. With `components` > 1
/// every node carries that many unknowns: number components * node + c.
SparseMatrix pair_pattern(const Grid& grid, int components);

/// A function whose diagonal entry of a mass matrix is below this fraction of the largest holds at most the
/// corner of one particle: its value would be a quotient of two near zeros, so it is left out.
inline constexpr double negligible_mass = 1e-6;

/// Makes a symmetric matrix leave the marked unknowns alone: their rows and columns become `diagonal` times
/// those of the identity.
void decouple(SparseMatrix& matrix, const std::vector<char>& marked, double diagonal);

/// A nodal field as a matrix of one row a node.
using FieldRows = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>>;
FieldRows rows_of(VectorField& field);

}  // namespace mpm
