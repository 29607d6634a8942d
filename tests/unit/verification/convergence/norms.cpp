#include "verification/convergence/norms.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/catch.hpp"

using verification::error_norms;
using verification::Norms;

namespace {

// A handful of roundings: sums of at most five terms, one root, one division.
Approx near(double value) {
  return Approx(value).epsilon(1e-14).margin(0.0);
}

bool all_nan(const Norms& n) {
  return std::isnan(n.l1) && std::isnan(n.l2) && std::isnan(n.linf);
}

}  // namespace

TEST_CASE("norms of a scalar sample follow their definitions", "[convergence]") {
  const Norms n = error_norms(std::vector<double>{3.0, -4.0, 0.0, 12.0}, 2.0);
  CHECK(n.l1 == near(19.0 / 4.0 / 2.0));
  CHECK(n.l2 == near(std::sqrt(169.0 / 4.0) / 2.0));
  CHECK(n.linf == near(6.0));
}

TEST_CASE("norms of a vector sample use the Euclidean length", "[convergence]") {
  const Norms n = error_norms(std::vector<Eigen::Vector2d>{{3.0, -4.0}, {0.0, 0.0}}, 10.0);
  CHECK(n.l1 == near(0.25));
  CHECK(n.l2 == near(std::sqrt(12.5) / 10.0));
  CHECK(n.linf == near(0.5));
}

TEST_CASE("weights are normalised and a zero weight leaves a point out", "[convergence]") {
  const std::vector<double> errors{1.0, 2.0, 50.0};
  const Norms n = error_norms(errors, 1.0, {30.0, 10.0, 0.0});
  CHECK(n.l1 == near(1.25));
  CHECK(n.l2 == near(std::sqrt(1.75)));
  CHECK(n.linf == near(2.0));
  const Norms equal = error_norms(errors, 1.0);
  const Norms same = error_norms(errors, 1.0, {7.0, 7.0, 7.0});
  CHECK(same.l1 == near(equal.l1));
  CHECK(same.l2 == near(equal.l2));
  CHECK(same.linf == near(equal.linf));
}

TEST_CASE("norms neither overflow nor underflow", "[convergence]") {
  for (double magnitude : {1e-250, 1e250}) {
    const Norms n = error_norms(std::vector<double>{3.0 * magnitude, 4.0 * magnitude}, magnitude);
    CHECK(n.l2 == near(std::sqrt(12.5)));
  }
  const Norms zero = error_norms(std::vector<double>{0.0, 0.0}, 1.0);
  CHECK(zero.l1 == 0.0);
  CHECK(zero.l2 == 0.0);
  CHECK(zero.linf == 0.0);
}

TEST_CASE("one bad entry makes every norm NaN", "[convergence]") {
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
               -std::numeric_limits<double>::infinity());
  for (std::size_t place = 0; place < 3; ++place) {
    std::vector<double> errors{1.0, 1.0, 1.0};
    errors[place] = bad;
    CHECK(all_nan(error_norms(errors, 1.0)));
    std::vector<Eigen::Vector2d> vectors(3, Eigen::Vector2d(1.0, 1.0));
    vectors[place].y() = bad;
    CHECK(all_nan(error_norms(vectors, 1.0)));
  }
  // Even where its weight would hide it.
  CHECK(all_nan(error_norms(std::vector<double>{1.0, bad}, 1.0, {1.0, 0.0})));
  CHECK(all_nan(error_norms(
      std::vector<Eigen::Vector2d>{{std::numeric_limits<double>::infinity(), bad}, {0.0, 0.0}}, 1.0)));
}

TEST_CASE("norms refuse bad arguments", "[convergence]") {
  const std::vector<double> one{1.0};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(error_norms(std::vector<double>{}, 1.0), std::invalid_argument);
  CHECK_THROWS_WITH(error_norms(std::vector<double>{}, 1.0), contains("empty"));
  for (double scale : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_WITH(error_norms(one, scale), contains("scale"));
  }
  CHECK_THROWS_WITH(error_norms(one, 1.0, {1.0, 1.0}), contains("one weight"));
  CHECK_THROWS_WITH(error_norms(one, 1.0, {-1.0}), contains("weights"));
  CHECK_THROWS_WITH(error_norms(one, 1.0, {nan}), contains("weights"));
  CHECK_THROWS_WITH(error_norms(one, 1.0, {0.0}), contains("sum"));
}
