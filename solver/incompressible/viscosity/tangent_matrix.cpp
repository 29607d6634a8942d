#include "solver/incompressible/viscosity/tangent_matrix.hpp"

#include <algorithm>

namespace mpm::incompressible {

TangentMatrix::TangentMatrix(const StreamFunction& psi, int cells_x, int cells_y, int k,
                             const SparseMatrix& mass)
    : cells_x_(cells_x) {
  const int size = (k + 1) * (k + 1);
  entries_ = static_cast<std::size_t>(size * (size + 1) / 2);
  const auto share = [&](int cell_x, int cell_y, int m) {
    return psi.share(cell_x + m % (k + 1), cell_y + m / (k + 1));
  };
  const auto each_pair = [&](const auto& visit) {
    for (int cy = 0; cy < cells_y; ++cy)
      for (int cx = 0; cx < cells_x; ++cx)
        for (int n = 0; n < size; ++n)
          for (int m = 0; m <= n; ++m) visit(share(cx, cy, m), share(cx, cy, n), m == n);
  };
  std::vector<Eigen::Triplet<double>> entries;
  each_pair([&](const auto& a, const auto& b, bool) {
    if (a.coordinate >= 0 && b.coordinate >= 0)
      entries.emplace_back(std::max(a.coordinate, b.coordinate), std::min(a.coordinate, b.coordinate), 0.0);
  });
  SparseMatrix pattern(mass.rows(), mass.cols());
  pattern.setFromTriplets(entries.begin(), entries.end());
  sum_ = pattern + SparseMatrix(mass.triangularView<Eigen::Lower>());
  sum_.makeCompressed();
  mass_ = Eigen::Map<const VectorXd>(sum_.valuePtr(), sum_.nonZeros());
  tangent_ = VectorXd::Zero(mass_.size());

  places_.reserve(static_cast<std::size_t>(cells_x * cells_y) * entries_);
  each_pair([&](const auto& a, const auto& b, bool same_function) {
    if (a.coordinate < 0 || b.coordinate < 0) return places_.push_back({0, 0});
    const int row = std::max(a.coordinate, b.coordinate), column = std::min(a.coordinate, b.coordinate);
    const int* const begin = sum_.innerIndexPtr() + sum_.outerIndexPtr()[column];
    const int* const end = sum_.innerIndexPtr() + sum_.outerIndexPtr()[column + 1];
    const auto at = static_cast<int>(std::lower_bound(begin, end, row) - sum_.innerIndexPtr());
    places_.push_back({at, a.sign * b.sign * (row == column && !same_function ? 2 : 1)});
  });
}

void TangentMatrix::clear() {
  tangent_.setZero();
}

void TangentMatrix::add(int cell_x, int cell_y, const double* entries, int pitch) {
  const Place* place = places_.data() + static_cast<std::size_t>(cell_x + cells_x_ * cell_y) * entries_;
  double* const values = tangent_.data();
  for (std::size_t e = 0; e < entries_; ++e, ++place, entries += pitch)
    values[place->at] += place->factor * *entries;
}

const SparseMatrix& TangentMatrix::with_mass(double a) {
  Eigen::Map<VectorXd>(sum_.valuePtr(), sum_.nonZeros()) = mass_ + a * tangent_;
  return sum_;
}

SparseMatrix TangentMatrix::tangent() const {
  SparseMatrix lower = sum_;
  Eigen::Map<VectorXd>(lower.valuePtr(), lower.nonZeros()) = tangent_;
  return lower.selfadjointView<Eigen::Lower>();
}

}  // namespace mpm::incompressible
