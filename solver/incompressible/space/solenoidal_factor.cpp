#include "solver/incompressible/space/solenoidal_factor.hpp"

#include <cmath>
#include <numbers>

namespace mpm::incompressible {
namespace {

/// Waves in the length, of mode m of n: 0, 1, 1, 2, 2, ...
int waves(int m) {
  return (m + 1) / 2;
}

double angle(int waves, int i, int n) {
  return 2 * std::numbers::pi * (static_cast<long>(waves) * i % n) / n;
}

/// Columns 1, cos, sin, cos, sin, ... over n places, the last one alternating for even n; orthonormal.
MatrixXd fourier_modes(int n) {
  MatrixXd modes(n, n);
  for (int m = 0; m < n; ++m) {
    const bool once = m == 0 || 2 * waves(m) == n;
    for (int i = 0; i < n; ++i) {
      const double at = angle(waves(m), i, n);
      modes(i, m) = std::sqrt((once ? 1.0 : 2.0) / n) * (m % 2 == 1 || m == 0 ? std::cos(at) : std::sin(at));
    }
  }
  return modes;
}

/// cos(2 pi k i/n) for the waves k of mode m (rows) at place i (columns).
MatrixXd cosines(int n) {
  MatrixXd values(n, n);
  for (int m = 0; m < n; ++m)
    for (int i = 0; i < n; ++i) values(m, i) = std::cos(angle(waves(m), i, n));
  return values;
}

}  // namespace

SolenoidalFactor::SolenoidalFactor(const VelocitySpace& space, const SparseMatrix& matrix,
                                   const std::optional<Diffusion>& diffusion) {
  if (space.axis(0).periodic() && space.axis(1).periodic()) {
    fourier_ = fourier(space, matrix);
  } else if (!space.axis(0).periodic() && !space.axis(1).periodic()) {
    walled_.emplace(space, diffusion);
  } else {
    cholesky_.compute(matrix);
    if (cholesky_.info() != Eigen::Success) throw SceneError("the mass of this grid could not be factorised");
  }
}

VectorXd SolenoidalFactor::solve(const VectorXd& load) const {
  if (fourier_) return solve(*fourier_, load);
  return walled_ ? walled_->solve(load) : VectorXd(cholesky_.solve(load));
}

SolenoidalFactor::Fourier SolenoidalFactor::fourier(const VelocitySpace& space, const SparseMatrix& matrix) {
  const int nx = space.axis(0).normal().count, ny = space.axis(1).normal().count, curls = nx * ny - 1;
  // What the first function meets. A constant stream function is no velocity: the sum over all is zero, which
  // says what the last one, no coordinate, would have.
  MatrixXd met = MatrixXd::Zero(nx, ny);
  if (curls > 0)
    for (SparseMatrix::InnerIterator entry(matrix, 0); entry; ++entry)
      if (entry.row() < curls) met.data()[entry.row()] = entry.value();
  met(nx - 1, ny - 1) = -met.sum();
  MatrixXd eigenvalues = cosines(nx) * met * cosines(ny).transpose();
  eigenvalues(0, 0) = 1;
  const Vec2 uniform(matrix.coeff(curls, curls), matrix.coeff(curls + 1, curls + 1));
  if (!(eigenvalues.minCoeff() > 0 && uniform.minCoeff() > 0))
    throw SceneError("the mass of this grid could not be factorised");
  MatrixXd inverse = eigenvalues.cwiseInverse();
  inverse(0, 0) = 0;
  const MatrixXd x = ModeProducts::zero_padded(fourier_modes(nx)),
                 y = ModeProducts::zero_padded(fourier_modes(ny));
  return {nx, ny, x, y, x.transpose(), y.transpose(), ModeProducts::zero_padded(inverse), uniform, {}};
}

VectorXd SolenoidalFactor::solve(const Fourier& fourier, const VectorXd& load) {
  const Eigen::Index rows = fourier.rows, columns = fourier.columns, curls = rows * columns - 1;
  VectorXd w(load.size());
  w.head(curls) = load.head(curls);
  w[curls] = -load.head(curls).sum();
  MatrixXd psi = ModeProducts::zero_padded(w.head(curls + 1).reshaped(rows, columns));
  fourier.multiply(fourier.transposed_x, psi, fourier.modes_y, psi);
  psi = fourier.inverse.cwiseProduct(psi);
  fourier.multiply(fourier.modes_x, psi, fourier.transposed_y, psi);
  w.head(curls + 1) = (psi.topLeftCorner(rows, columns).array() - psi(rows - 1, columns - 1)).reshaped();
  for (const int a : {0, 1}) w[curls + a] = load[curls + a] / fourier.uniform[a];
  return w;
}

}  // namespace mpm::incompressible
