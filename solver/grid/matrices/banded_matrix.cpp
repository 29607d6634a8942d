#include "solver/grid/matrices/banded_matrix.hpp"

#include <algorithm>

namespace mpm {

double BandedMatrix::row_times(int row, const double* vector) const {
  double sum = 0;
  for (int j = std::max(0, row - reach_); j <= row; ++j) sum += at(row, j) * vector[j];
  for (int i = row + 1; i <= std::min(size_ - 1, row + reach_); ++i) sum += at(i, row) * vector[i];
  return sum;
}

void BandedMatrix::add_column(int column, double factor, double* vector) const {
  for (int i = std::max(0, column - reach_); i < column; ++i) vector[i] += factor * at(column, i);
  for (int i = column; i <= std::min(size_ - 1, column + reach_); ++i) vector[i] += factor * at(i, column);
}

void BandedMatrix::decouple(const std::vector<char>& marked) {
  double largest = 0;
  for (int i = 0; i < size_; ++i) largest = std::max(largest, at(i, i));
  for (int i = 0; i < size_; ++i)
    for (int j = std::max(0, i - reach_); j <= i; ++j)
      if (marked[static_cast<std::size_t>(i)] || marked[static_cast<std::size_t>(j)])
        at(i, j) = i == j ? largest : 0;
}

void BandedMatrix::factorise() {
  bool alternates = true;
  for (int i = 0; i < size_; ++i)
    for (int j = i - 1; j >= std::max(0, i - reach_); j -= 2) alternates = alternates && at(i, j) == 0;
  stride_ = alternates ? 2 : 1;
  for (int i = 0; i < size_; ++i) {
    const int first = i - std::min(i, reach_) / stride_ * stride_;
    double pivot = at(i, i);
    for (int j = first; j < i; j += stride_) {  // at(i, k) holds L_ik D_k for k < j
      double entry = at(i, j);
      for (int k = std::max(first, j - reach_ / stride_ * stride_); k < j; k += stride_)
        entry -= at(i, k) * at(j, k);
      at(i, j) = entry;
    }
    for (int j = first; j < i; j += stride_) {
      const double scaled = at(i, j);
      at(i, j) = scaled / at(j, j);
      pivot -= scaled * at(i, j);
    }
    at(i, i) = pivot;
  }
}

void BandedMatrix::solve(double* x) const {
  // Both sweeps gather into a register, the nearest unknown last: a row waits for its neighbour's sum alone.
  const double* diagonal = band_.data() + reach_;
  for (int i = 0; i < size_; ++i, diagonal += reach_ + 1) {
    double sum = x[i];
    for (int k = std::min(i, reach_) / stride_ * stride_; k > 0; k -= stride_) sum -= diagonal[-k] * x[i - k];
    x[i] = sum;
  }
  diagonal = band_.data() + reach_;
  for (int i = 0; i < size_; ++i, diagonal += reach_ + 1) x[i] /= *diagonal;
  for (int i = size_ - 1; i >= 0; --i) {
    diagonal -= reach_ + 1;
    double sum = x[i];
    for (int k = std::min(size_ - 1 - i, reach_) / stride_ * stride_; k > 0; k -= stride_)
      sum -= diagonal[k * reach_] * x[i + k];  // of row i + k
    x[i] = sum;
  }
}

}  // namespace mpm
