#include "solver/grid/matrices/banded_matrix.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "tests/catch.hpp"

using namespace mpm;

namespace {

/// A positive definite band, and the same written out. `alternates`: without every other entry beside the
/// diagonal.
Eigen::MatrixXd fill(BandedMatrix& band, bool alternates) {
  const int n = band.size();
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = std::max(0, i - band.reach()); j <= i; ++j) {
      if (alternates && (i - j) % 2 == 1) continue;
      full(i, j) = full(j, i) = i == j ? 2 * band.reach() + 1.0 : std::sin(1.0 + i + 3 * j);
      band.at(i, j) = full(i, j);
    }
  return full;
}

}  // namespace

TEST_CASE(
    "a band multiplies and solves as the matrix written out does, whether or not its entries alternate") {
  const bool alternates = GENERATE(false, true);
  const int reach = GENERATE(1, 3, 7);
  BandedMatrix band(23, reach);
  const Eigen::MatrixXd full = fill(band, alternates);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(23, -1, 2).array().cos();
  for (int i = 0; i < 23; ++i) {
    CHECK(band.row_times(i, b.data()) == Approx(full.row(i).dot(b)).margin(1e-13));
    Eigen::VectorXd sum = b;
    band.add_column(i, 0.7, sum.data());
    CHECK((sum - b - 0.7 * full.col(i)).norm() < 1e-13);
  }
  Eigen::VectorXd x = b;
  band.factorise();
  band.solve(x.data());
  CHECK((full * x - b).norm() < 1e-13);
}

TEST_CASE("unknowns of a band that are marked leave the others alone") {
  BandedMatrix band(9, 2);
  Eigen::MatrixXd full = fill(band, false);
  std::vector<char> marked(9, 0);
  marked[0] = marked[5] = 1;
  band.decouple(marked);
  for (const int i : {0, 5}) {
    full.row(i).setZero();
    full.col(i).setZero();
    full(i, i) = 5;  // the largest of the diagonal, 2 reach + 1
  }
  for (int i = 0; i < 9; ++i)
    for (int j = std::max(0, i - 2); j <= i; ++j) CHECK(band.at(i, j) == full(i, j));
}
