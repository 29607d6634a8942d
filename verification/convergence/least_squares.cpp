#include "verification/convergence/least_squares.hpp"

#include <gsl/gsl_linalg.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace verification {
namespace {

using Vector = std::unique_ptr<gsl_vector, decltype(&gsl_vector_free)>;
Vector vector_of(std::size_t size) {
  return {gsl_vector_alloc(size), &gsl_vector_free};
}

}  // namespace

// GSL, not Eigen, whose decomposition by columns takes three seconds to compile.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const auto m = static_cast<std::size_t>(a.rows()), n = static_cast<std::size_t>(a.cols());
  if (n == 0 || m < n || a.rows() != b.size())
    throw std::invalid_argument(
        "least squares need as many equations as unknowns, and a right-hand side for each");
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  if (!a.allFinite() || !b.allFinite())
    return Eigen::VectorXd::Constant(a.cols(), std::numeric_limits<double>::quiet_NaN());
  RowMajor factors = a;
  gsl_matrix_view qr = gsl_matrix_view_array(factors.data(), m, n);
  const Vector tau = vector_of(n), norm = vector_of(n), residual = vector_of(m);
  const std::unique_ptr<gsl_permutation, decltype(&gsl_permutation_free)> order(gsl_permutation_alloc(n),
                                                                                &gsl_permutation_free);
  int sign = 0;
  gsl_linalg_QRPT_decomp(&qr.matrix, tau.get(), order.get(), &sign, norm.get());
  const double least =
      static_cast<double>(n) * std::numeric_limits<double>::epsilon() * std::abs(factors(0, 0));
  std::size_t rank = 0;
  while (rank < n && std::abs(qr.matrix.data[rank * (n + 1)]) > least) ++rank;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  if (rank == 0) return x;
  const gsl_vector_const_view right = gsl_vector_const_view_array(b.data(), m);
  gsl_vector_view solution = gsl_vector_view_array(x.data(), n);
  gsl_linalg_QRPT_lssolve2(&qr.matrix, tau.get(), order.get(), &right.vector, rank, &solution.vector,
                           residual.get());
  return x;
}

}  // namespace verification
