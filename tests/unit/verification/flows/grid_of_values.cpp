#include "verification/flows/grid_of_values.hpp"

#include <cmath>
#include <stdexcept>

#include "tests/catch.hpp"

using namespace verification;

namespace {

double wave(double x) {
  return std::sin(2 * 3.14159265358979323846 * x);
}

/// Largest error between the centres of n x n cells of a periodic box of u = sin(2 pi x), v = sin(2 pi y).
double error_between(int n, Interpolation rule) {
  std::vector<GridOfValues::Row> rows;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec2 x((i + 0.5) / n, (j + 0.5) / n);
      rows.push_back({x, {wave(x.x()), wave(x.y())}});
    }
  const GridOfValues grid(rows, Vec2(1, 1), 1, false, rule);
  double worst = 0;
  for (int i = 0; i <= 50; ++i) {
    const Vec2 x(i / 50.0, 1 - i / 50.0);
    worst = std::max(worst, (grid.at(x) - Vec2(wave(x.x()), wave(x.y()))).cwiseAbs().maxCoeff());
  }
  return worst;
}

}  // namespace

TEST_CASE(
    "values between the points of a grid: second order by lines, fourth by cubics, also around a period") {
  CHECK(std::log2(error_between(16, Interpolation::Linear) / error_between(32, Interpolation::Linear)) ==
        Approx(2).margin(0.2));
  CHECK(std::log2(error_between(16, Interpolation::Cubic) / error_between(32, Interpolation::Cubic)) ==
        Approx(4).margin(0.2));
}

TEST_CASE("a line of values counts the place across alone, and says nothing outside") {
  std::vector<GridOfValues::Row> rows;
  for (int j = 4; j >= 0; --j) rows.push_back({{7.0, 0.25 * j}, {std::pow(0.25 * j, 3), 0}});
  const GridOfValues line(rows, Vec2::Zero(), 1, true, Interpolation::Cubic);
  for (const double y : {0.0, 0.1, 0.4, 0.77, 1.0}) CHECK(std::abs(line.at({0, y}).x() - y * y * y) < 1e-14);
  CHECK(std::isnan(line.at({7, 1.1}).x()));
  CHECK(std::isnan(line.at({7, -0.1}).x()));
}

TEST_CASE("points that are no grid are refused") {
  const std::vector<GridOfValues::Row> three{{{0, 0}, {0, 0}}, {{1, 0}, {0, 0}}, {{0, 1}, {0, 0}}};
  CHECK_THROWS_AS(GridOfValues(three, Vec2::Zero(), 1, false, Interpolation::Linear), std::invalid_argument);
  CHECK_THROWS_AS(GridOfValues({three[0]}, Vec2::Zero(), 1, false, Interpolation::Linear),
                  std::invalid_argument);
}
