#include "verification/convergence/least_squares.hpp"

#include <limits>
#include <stdexcept>

#include "tests/catch.hpp"

using namespace verification;

TEST_CASE("least squares solve the normal equations, whatever the order of the columns' sizes") {
  Eigen::MatrixXd a(4, 3);
  a << 1, 1e-3, 100, 1, 2e-3, -50, 1, 4e-3, 20, 1, 7e-3, 10;
  const Eigen::Vector4d b(1, -2, 3, 5);
  const Eigen::VectorXd x = least_squares(a, b);
  // The residual is orthogonal to all columns: round-off in products of their sizes, 20 times over.
  const Eigen::VectorXd left = a.transpose() * (a * x - b);
  for (Eigen::Index k = 0; k < 3; ++k)
    CHECK(std::abs(left[k]) < 20 * std::numeric_limits<double>::epsilon() * a.col(k).norm() * b.norm());
}

TEST_CASE(
    "least squares: a column that depends on another gets no part, and nothing hides what is no number") {
  Eigen::MatrixXd a(3, 2);
  a << 1, 2, 2, 4, 3, 6;
  const Eigen::Vector3d b(2, 4, 6);
  const Eigen::VectorXd x = least_squares(a, b);
  CHECK(x[0] == 0);
  CHECK(x[1] == Approx(1));
  CHECK(least_squares(Eigen::MatrixXd::Zero(3, 2), b) == Eigen::Vector2d::Zero());
  a(2, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(least_squares(a, b).hasNaN());
  CHECK_THROWS_AS(least_squares(Eigen::MatrixXd::Ones(1, 2), Eigen::VectorXd::Ones(1)),
                  std::invalid_argument);
}
