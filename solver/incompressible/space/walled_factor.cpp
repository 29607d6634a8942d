#include "solver/incompressible/space/walled_factor.hpp"

#include <Eigen/Eigenvalues>
#include <limits>

#include "solver/incompressible/space/exact_mass.hpp"

namespace mpm::incompressible {

WalledFactor::Modes WalledFactor::modes(const SplineAxis& axis, const std::optional<Diffusion>& diffusion,
                                        int a) {
  const MatrixXd mass = over_unknowns(axis.mass(0), axis.normal());
  const MatrixXd stiffness = over_unknowns(axis.stiffness(0), axis.normal());
  MatrixXd all = stiffness;
  if (diffusion) {
    const SparseMatrix slopes = axis.derivative() * axis.normal().extension();
    const SparseMatrix held = diffusion->held[static_cast<std::size_t>(a)] * slopes;
    all += diffusion->area * MatrixXd(SparseMatrix(slopes.transpose() * held));
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(all, mass);
  if (eigen.info() != Eigen::Success || !(eigen.eigenvalues()[0] > 0))
    throw SceneError("the mass of this grid could not be factorised");
  const MatrixXd& q = eigen.eigenvectors();
  return {ModeProducts::zero_padded(q), ModeProducts::zero_padded(q.transpose()),
          ModeProducts::zero_padded(q.transpose() * stiffness * q), eigen.eigenvalues()};
}

WalledFactor::WalledFactor(const VelocitySpace& space, const std::optional<Diffusion>& diffusion)
    : rows_(space.axis(0).normal().count),
      columns_(space.axis(1).normal().count),
      x_(modes(space.axis(0), diffusion, 0)),
      y_(modes(space.axis(1), diffusion, 1)),
      twice_area_(diffusion ? 2 * diffusion->area : 0),
      sums_(MatrixXd::Zero(x_.modes.rows(), y_.modes.rows())),
      inverse_diagonal_(sums_) {
  for (Eigen::Index j = 0; j < columns_; ++j)
    for (Eigen::Index i = 0; i < rows_; ++i) {
      sums_(i, j) = x_.eigenvalues[i] + y_.eigenvalues[j];
      inverse_diagonal_(i, j) = 1 / (sums_(i, j) + twice_area_ * x_.stiffness(i, i) * y_.stiffness(j, j));
    }
}

VectorXd WalledFactor::solve(const VectorXd& load) const {
  // Relative, in the norm of the preconditioner: what Cholesky's factor would leave.
  constexpr double tolerance = 1e-14;
  constexpr int most_iterations = 60;  // 3 to 14 were seen
  MatrixXd r = MatrixXd::Zero(sums_.rows(), sums_.cols()), x, product;
  r.topLeftCorner(rows_, columns_) = load.reshaped(rows_, columns_);
  multiply_(x_.transposed, r, y_.modes, r);
  MatrixXd z = inverse_diagonal_.cwiseProduct(r);
  if (twice_area_ == 0) {
    x = z;
  } else {
    x.setZero(r.rows(), r.cols());
    MatrixXd p = z;
    double rz = r.cwiseProduct(z).sum();
    const double enough = tolerance * tolerance * rz;
    for (int k = 0; k < most_iterations && !(rz <= enough); ++k) {
      multiply_(x_.stiffness, p, y_.stiffness, product);
      product = twice_area_ * product + sums_.cwiseProduct(p);
      const double alpha = rz / p.cwiseProduct(product).sum();
      x += alpha * p;
      r -= alpha * product;
      z = inverse_diagonal_.cwiseProduct(r);
      const double next = r.cwiseProduct(z).sum();
      p = z + (next / rz) * p;
      rz = next;
    }
    // What is no solution must not pass for one: it is found as a breakdown.
    if (!(rz <= enough)) x.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  multiply_(x_.modes, x, y_.transposed, product);
  return product.topLeftCorner(rows_, columns_).reshaped();
}

}  // namespace mpm::incompressible
