#include "solver/incompressible/space/walled_factor.hpp"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>

#include <limits>
#include <memory>

#include "solver/grid/matrices/quiet_gsl.hpp"
#include "solver/incompressible/space/exact_mass.hpp"

namespace mpm::incompressible {
namespace {

struct GeneralisedModes {
  VectorXd eigenvalues;
  MatrixXd eigenvectors;  // a column each
};

/// Of a q = lambda m q, both matrices symmetric, q^T m q = 1, in ascending order. GSL, not Eigen, whose
/// solver takes ten seconds to compile.
/// @throws SceneError where m is not positive definite.
GeneralisedModes generalised_modes(MatrixXd a, const MatrixXd& mass) {
  MatrixXd m = mass;  // both are worked on in place
  const auto n = static_cast<std::size_t>(a.rows());
  GeneralisedModes modes{VectorXd(a.rows()), MatrixXd(a.rows(), a.rows())};
  // Rows are columns there: the same for what is symmetric, turned round for the vectors.
  gsl_matrix_view of_a = gsl_matrix_view_array(a.data(), n, n), of_m = gsl_matrix_view_array(m.data(), n, n),
                  vectors = gsl_matrix_view_array(modes.eigenvectors.data(), n, n);
  gsl_vector_view values = gsl_vector_view_array(modes.eigenvalues.data(), n);
  const std::unique_ptr<gsl_eigen_gensymmv_workspace, decltype(&gsl_eigen_gensymmv_free)> room(
      gsl_eigen_gensymmv_alloc(n), &gsl_eigen_gensymmv_free);
  quiet_gsl();
  if (gsl_eigen_gensymmv(&of_a.matrix, &of_m.matrix, &values.vector, &vectors.matrix, room.get()) !=
      GSL_SUCCESS)
    throw SceneError("the mass of this grid could not be factorised");
  gsl_eigen_gensymmv_sort(&values.vector, &vectors.matrix, GSL_EIGEN_SORT_VAL_ASC);
  modes.eigenvectors.transposeInPlace();
  const VectorXd square = (mass * modes.eigenvectors).cwiseProduct(modes.eigenvectors).colwise().sum();
  modes.eigenvectors *= square.cwiseSqrt().cwiseInverse().asDiagonal();
  return modes;
}

}  // namespace

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
  const auto [lambda, q] = generalised_modes(all, mass);
  if (!(lambda[0] > 0)) throw SceneError("the mass of this grid could not be factorised");
  return {ModeProducts::zero_padded(q), ModeProducts::zero_padded(q.transpose()),
          ModeProducts::zero_padded(q.transpose() * stiffness * q), lambda};
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
