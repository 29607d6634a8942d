#pragma once

#include <Eigen/Core>
#include <vector>

namespace mpm {

/// A symmetric matrix without entries further than `reach` from the diagonal, and its factors L D L^T (Golub
/// and Van Loan, Matrix Computations, ch. 4.3): on a strip they have no entries beside those of the band.
/// Where unknowns of two kinds alternate that know nothing of each other, every other entry is left out.
class BandedMatrix {
 public:
  BandedMatrix(int size, int reach)
      : size_(size), reach_(reach), band_(static_cast<std::size_t>(size * (reach + 1)), 0.0) {}

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int reach() const { return reach_; }
  void set_zero() { std::fill(band_.begin(), band_.end(), 0.0); }

  /// The entry at row >= column, row - column <= reach. After factorise(): L's, and D's on the diagonal.
  double& at(int row, int column) { return band_[place(row, column)]; }
  [[nodiscard]] double at(int row, int column) const { return band_[place(row, column)]; }

  /// A row of the matrix times a vector of `size` numbers.
  [[nodiscard]] double row_times(int row, const double* vector) const;
  /// vector += a column of the matrix times a factor.
  void add_column(int column, double factor, double* vector) const;
  /// Makes the marked unknowns leave the others alone: their rows and columns become those of the identity
  /// times the largest entry of the diagonal.
  void decouple(const std::vector<char>& marked);
  /// Puts L and D in place of the entries. The matrix must be positive definite.
  void factorise();
  /// x <- A^-1 x, by the factors.
  void solve(double* x) const;

 private:
  [[nodiscard]] std::size_t place(int row, int column) const {
    return static_cast<std::size_t>(row * (reach_ + 1) + column - row + reach_);
  }

  int size_, reach_;
  int stride_ = 1;            // between the factors' entries in a row
  std::vector<double> band_;  // row by row, the diagonal last
};

}  // namespace mpm
