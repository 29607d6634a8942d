#include "solver/grid/matrices/sparse_pattern.hpp"

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

namespace {

/// Number of the function at a distance from another along an axis; -1 where there is none.
int neighbour(const Axis& axis, int i, int distance) {
  if (!axis.periodic) return i + distance < 0 || i + distance >= axis.count() ? -1 : i + distance;
  return ((i + distance) % axis.cells + axis.cells) % axis.cells;
}

}  // namespace

PairSlots::PairSlots(const Grid& grid, const SparseMatrix& pattern, int components)
    : degree_(grid.x.degree), reach_(2 * degree_ + 1), components_(components) {
  const int nx = grid.x.count(), ny = grid.y.count();
  const auto find = [&](int row, int column) {
    const int* begin = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column];
    const int* end = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column + 1];
    return static_cast<std::size_t>(std::lower_bound(begin, end, row) - pattern.innerIndexPtr());
  };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      for (int dj = -degree_; dj <= degree_; ++dj)
        for (int di = -degree_; di <= degree_; ++di)
          for (int b = 0; b < components; ++b) {
            const int k = neighbour(grid.x, i, di), l = neighbour(grid.y, j, dj);
            // Pairs that share no cell stay unused.
            slot_.push_back(k < 0 || l < 0 ? 0
                                           : find(components * (j * nx + i), components * (l * nx + k) + b));
          }
}

std::vector<int> PairSlots::distances(int width, int support_x) const {
  std::vector<int> distances;
  for (int k = 0; k < width; ++k)
    for (int l = 0; l < width; ++l)
      distances.push_back((l / support_x - k / support_x + degree_) * reach_ + l % support_x - k % support_x +
                          degree_);
  return distances;
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

ConstFieldRows rows_of(const VectorField& field) {
  return {field.front().data(), static_cast<Eigen::Index>(field.size()), 2};
}

}  // namespace mpm
