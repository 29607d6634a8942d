#pragma once

#include <Eigen/Core>

namespace mpm {

// Dense symmetric positive definite matrices by GSL, of which only one triangle is read: Eigen's LLT is
// compiled anew wherever it is used.

/// L of L L^T = A.
/// @throws SceneError where A is not positive definite.
Eigen::MatrixXd cholesky_factor(Eigen::MatrixXd a);

/// x of A x = b.
/// @throws SceneError where A is not positive definite.
Eigen::VectorXd solve_positive_definite(Eigen::MatrixXd a, Eigen::VectorXd b);

}  // namespace mpm
