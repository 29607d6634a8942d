#pragma once

#include <algorithm>
#include <vector>

#include "solver/incompressible/space/velocity_space.hpp"

namespace mpm::incompressible {

/// Matrix that couples every function of a component with those that share a cell with it, diagonal by
/// diagonal: entry [offset](i, j) couples (i, j) with (i, j) + offset. A product is then a few dozen sums of
/// arrays.
class StencilDiagonals {
 public:
  /// Of `rows` x `columns` functions, each of which shares cells with `reach_x`, `reach_y` others to either
  /// side.
  StencilDiagonals(Eigen::Index rows, Eigen::Index columns, int reach_x, int reach_y)
      : reach_x_(reach_x),
        reach_y_(reach_y),
        diagonals_(static_cast<std::size_t>((2 * reach_x + 1) * (2 * reach_y + 1)),
                   MatrixXd::Zero(rows, columns)) {}

  void clear() {
    for (MatrixXd& diagonal : diagonals_) diagonal.setZero();
  }

  /// Adds a block over the functions (x .. x + nx, y .. y + ny) of one cell, numbered x first.
  template <class Block>
  void add(int x, int y, int nx, int ny, const Block& block) {
    for (int b = 0; b < ny; ++b)
      for (int a = 0; a < nx; ++a)
        for (int d = 0; d < ny; ++d)
          for (int c = 0; c < nx; ++c) at(c - a, d - b)(x + a, y + b) += block(a + nx * b, c + nx * d);
  }

  /// sum = A x.
  void multiply(const MatrixXd& x, MatrixXd& sum) const {
    sum.setZero(x.rows(), x.cols());
    for (int dy = -reach_y_; dy <= reach_y_; ++dy)
      for (int dx = -reach_x_; dx <= reach_x_; ++dx) {
        const Eigen::Index i = std::max(0, -dx), j = std::max(0, -dy);
        const Eigen::Index rows = x.rows() - std::abs(dx), columns = x.cols() - std::abs(dy);
        if (rows <= 0 || columns <= 0) continue;
        sum.block(i, j, rows, columns) +=
            at(dx, dy).block(i, j, rows, columns).cwiseProduct(x.block(i + dx, j + dy, rows, columns));
      }
  }

 private:
  [[nodiscard]] std::size_t place(int dx, int dy) const {
    return static_cast<std::size_t>((dx + reach_x_) + (2 * reach_x_ + 1) * (dy + reach_y_));
  }
  MatrixXd& at(int dx, int dy) { return diagonals_[place(dx, dy)]; }
  [[nodiscard]] const MatrixXd& at(int dx, int dy) const { return diagonals_[place(dx, dy)]; }

  int reach_x_, reach_y_;
  std::vector<MatrixXd> diagonals_;
};

}  // namespace mpm::incompressible
