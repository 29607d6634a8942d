#include "solver/grid/matrices/cholesky.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

#include "solver/grid/matrices/quiet_gsl.hpp"
#include "solver/scene/scene.hpp"

namespace mpm {
namespace {

gsl_matrix_view factorise(Eigen::MatrixXd& a) {
  const auto n = static_cast<std::size_t>(a.rows());
  gsl_matrix_view view = gsl_matrix_view_array(a.data(), n, n);
  quiet_gsl();
  if (gsl_linalg_cholesky_decomp1(&view.matrix) != GSL_SUCCESS)
    throw SceneError("a matrix of this grid is not positive definite");
  return view;
}

}  // namespace

Eigen::MatrixXd cholesky_factor(Eigen::MatrixXd a) {
  static_cast<void>(factorise(a));
  // Rows are columns there: its lower triangle is the upper one here.
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    for (Eigen::Index i = 0; i < j; ++i) {
      a(j, i) = a(i, j);
      a(i, j) = 0;
    }
  return a;
}

Eigen::VectorXd solve_positive_definite(Eigen::MatrixXd a, Eigen::VectorXd b) {
  const gsl_matrix_view factor = factorise(a);
  gsl_vector_view x = gsl_vector_view_array(b.data(), static_cast<std::size_t>(b.size()));
  gsl_linalg_cholesky_svx(&factor.matrix, &x.vector);
  return b;
}

}  // namespace mpm
