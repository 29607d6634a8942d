#include "solver/sparse_pattern.hpp"

#include <algorithm>
#include <utility>

namespace mpm {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

/// Pairs of functions of one axis that share a cell, each once.
Pairs pairs_along(const Axis& axis) {
  Pairs pairs;
  for (int cell = 0; cell < axis.cells; ++cell)
    for (int k = cell; k <= cell + axis.degree; ++k)
      for (int l = cell; l <= cell + axis.degree; ++l) pairs.emplace_back(axis.function(k), axis.function(l));
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

SparseMatrix pair_pattern(const Grid& grid, int components) {
  const Pairs along_x = pairs_along(grid.x), along_y = pairs_along(grid.y);
  const int nx = grid.x.count();
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [j, l] : along_y)
    for (const auto& [i, k] : along_x)
      for (int a = 0; a < components; ++a)
        for (int b = 0; b < components; ++b)
          entries.emplace_back(components * (j * nx + i) + a, components * (l * nx + k) + b, 0.0);
  const auto size = static_cast<Eigen::Index>(grid.size()) * components;
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void decouple(SparseMatrix& matrix, const std::vector<char>& marked, double diagonal) {
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      if (marked[static_cast<std::size_t>(entry.row())] || marked[static_cast<std::size_t>(column)])
        entry.valueRef() = entry.row() == column ? diagonal : 0;
}

FieldRows rows_of(VectorField& field) {
  return {field.front().data(), static_cast<Eigen::Index>(field.size()), 2};
}

}  // namespace mpm
