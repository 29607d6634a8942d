#pragma once

#include <Eigen/Core>

namespace verification {

/// The x that makes |A x - b| least, where A is m x n with m >= n: by QR with the columns in order of their
/// size, so that columns which depend on others get no part (Golub & Van Loan 2013, 5.4).
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace verification
