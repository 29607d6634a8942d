#include "verification/convergence/least_squares.hpp"

#include <Eigen/QR>

namespace verification {

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

}  // namespace verification
