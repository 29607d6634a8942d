#include <cmath>

#include "solver/basis.hpp"
#include "tests/catch.hpp"

using namespace mpm;

namespace {

Scene box(int nx, int ny, bool periodic_x, bool periodic_y) {
  Scene scene;
  scene.size = {0.3, 0.7};
  scene.cells = {nx, ny};
  if (!periodic_x) scene.side(Edge::Left) = scene.side(Edge::Right) = Side::wall(Vec2::Zero());
  if (!periodic_y) scene.side(Edge::Bottom) = scene.side(Edge::Top) = Side::wall(Vec2::Zero());
  return scene;
}

/// Points inside every cell, on every cell boundary and on the domain's edges.
VectorField probing_points(const Scene& scene) {
  VectorField points;
  for (int j = 0; j <= 3 * scene.cells[1]; ++j)
    for (int i = 0; i <= 3 * scene.cells[0]; ++i)
      points.emplace_back(scene.size.x() * i / (3 * scene.cells[0]),
                          scene.size.y() * j / (3 * scene.cells[1]));
  return points;
}

}  // namespace

TEST_CASE("basis functions sum to one and their gradients to zero everywhere") {
  const Scene scene = box(GENERATE(1, 2, 5), GENERATE(1, 4), GENERATE(true, false), GENERATE(true, false));
  const Grid grid(scene, LinearBasis::degree);
  for (const Vec2& point : probing_points(scene)) {
    double sum = 0;
    Vec2 slope = Vec2::Zero();
    const Stencil<LinearBasis> stencil(grid, point);
    stencil.values([&](std::size_t i, double n) {
      REQUIRE(i < grid.size());
      sum += n;
    });
    stencil.gradients([&](std::size_t, const Vec2& dn) { slope += dn; });
    // Sums of four products of order one, and of order 1/h = 20: a few units of round-off.
    REQUIRE(std::abs(sum - 1) < 1e-15);
    REQUIRE(slope.norm() < 1e-13);
  }
}

TEST_CASE("a linear field between walls is reproduced, with its gradient") {
  const Scene scene = box(4, 7, false, false);
  const Grid grid(scene, LinearBasis::degree);
  Mat2 a;
  a << 1.5, -2, 0.25, 3;
  const Vec2 b(0.1, -0.7);
  VectorField field(grid.size());
  for (int j = 0; j < grid.y.count(); ++j)
    for (int i = 0; i < grid.x.count(); ++i)
      field[static_cast<std::size_t>(j * grid.x.count() + i)] = a * Vec2(i * grid.x.h, j * grid.y.h) + b;
  for (const Vec2& point : probing_points(scene)) {
    REQUIRE((interpolate<LinearBasis>(grid, field, point) - (a * point + b)).norm() < 1e-14);
    REQUIRE((gradient<LinearBasis>(grid, field, point) - a).norm() < 1e-12);
  }
}

TEST_CASE("gradients are the derivatives of the values") {
  const Scene scene = box(3, 5, true, false);
  const Grid grid(scene, LinearBasis::degree);
  VectorField field(grid.size());
  for (std::size_t i = 0; i < field.size(); ++i)
    field[i] = {std::sin(3.0 * static_cast<double>(i)), std::cos(2.0 * static_cast<double>(i))};
  const double e = 1e-6;
  for (const Vec2& point : {Vec2(0.031, 0.1), Vec2(0.17, 0.33), Vec2(0.299, 0.61)}) {
    const Mat2 g = gradient<LinearBasis>(grid, field, point);
    for (int axis : {0, 1}) {
      Vec2 d = Vec2::Zero();
      d[axis] = e;
      const Vec2 difference = (interpolate<LinearBasis>(grid, field, point + d) -
                               interpolate<LinearBasis>(grid, field, point - d)) /
                              (2 * e);
      // Inside a cell the field is bilinear: central differences are exact up to round-off/e.
      REQUIRE((difference - g.col(axis)).norm() < 1e-8);
    }
  }
}

TEST_CASE("periodic coordinates wrap, others report that they left") {
  const Scene scene = box(3, 5, true, false);
  const Grid grid(scene, LinearBasis::degree);
  double x = 0.31;
  CHECK(grid.x.contain(x));
  CHECK(x == Approx(0.01));
  x = -0.05;
  CHECK(grid.x.contain(x));
  CHECK(x == Approx(0.25));
  x = 1e9;
  CHECK(grid.x.contain(x));
  CHECK((x >= 0 && x <= 0.3));
  x = NAN;
  CHECK_FALSE(grid.x.contain(x));
  double y = 0.7000001;
  CHECK_FALSE(grid.y.contain(y));
}
