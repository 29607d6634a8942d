#include <algorithm>
#include <cmath>

#include "solver/grid/stencil.hpp"
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

template <class Basis>
void require_partition_of_unity(const Scene& scene) {
  const Grid grid(scene, Basis::degree);
  for (const Vec2& point : probing_points(scene)) {
    double sum = 0, least = 1;
    Vec2 slope = Vec2::Zero();
    const Stencil<Basis> stencil(grid, point);
    stencil.values([&](std::size_t i, double n) {
      REQUIRE(i < grid.size());
      sum += n;
      least = std::min(least, n);
    });
    stencil.gradients([&](std::size_t, const Vec2& dn) { slope += dn; });
    // Sums of up to 16 products of order one, and of order 1/h = 20: a few units of round-off each.
    REQUIRE(std::abs(sum - 1) < 2e-15);
    REQUIRE(least > -1e-15);
    REQUIRE(slope.norm() < 2e-13);
  }
}

template <class Basis>
void require_linear_reproduction(const Scene& scene) {
  const Grid grid(scene, Basis::degree);
  Mat2 a;
  a << 1.5, -2, 0.25, 3;
  const Vec2 b(0.1, -0.7);
  VectorField field(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) field[i] = a * grid.control_point(i) + b;
  for (const Vec2& point : probing_points(scene)) {
    REQUIRE((interpolate<Basis>(grid, field, point) - (a * point + b)).norm() < 1e-14);
    REQUIRE((gradient<Basis>(grid, field, point) - a).norm() < 1e-12);
    Vec2 moment = Vec2::Zero();
    Stencil<Basis>(grid, point).offsets([&](std::size_t, double n, const Vec2& offset) {
      moment += n * offset;
    });
    REQUIRE(moment.norm() < 1e-15);  // round-off of lengths below 0.8
  }
}

/// A nodal field without any symmetry.
VectorField rough_field(const Grid& grid) {
  VectorField field(grid.size());
  for (std::size_t i = 0; i < field.size(); ++i)
    field[i] = {std::sin(3.0 * static_cast<double>(i)), std::cos(2.0 * static_cast<double>(i))};
  return field;
}

template <class Basis>
void require_derivatives(const Scene& scene) {
  const Grid grid(scene, Basis::degree);
  const VectorField field = rough_field(grid);
  const double e = 1e-6;
  for (int j = 0; j < scene.cells[1]; ++j) {
    for (int i = 0; i < scene.cells[0]; ++i) {
      for (const Vec2& s : {Vec2(0.01, 0.97), Vec2(0.4, 0.3), Vec2(0.985, 0.02)}) {
        const Vec2 point((i + s.x()) * grid.x.h, (j + s.y()) * grid.y.h);
        const Mat2 g = gradient<Basis>(grid, field, point);
        for (int axis : {0, 1}) {
          Vec2 d = Vec2::Zero();
          d[axis] = e;
          const Vec2 difference =
              (interpolate<Basis>(grid, field, point + d) - interpolate<Basis>(grid, field, point - d)) /
              (2 * e);
          // Round-off 1e-16/e = 1e-10; truncation e^2/6 times a third derivative below 40/h^3 = 4e4: 7e-9.
          REQUIRE((difference - g.col(axis)).norm() < 1e-8);
        }
      }
    }
  }
}

/// The same values on both sides of every cell boundary; derivatives too where the basis is smooth.
template <class Basis>
void require_continuity(const Scene& scene) {
  const Grid grid(scene, Basis::degree);
  const VectorField field = rough_field(grid);
  const Vec2 e(0, 1e-13);
  for (int j = 1; j < scene.cells[1]; ++j) {
    const Vec2 point(0.37 * grid.x.h, j * grid.y.h);
    // Slopes are below 100 per metre, second derivatives below 1e4.
    REQUIRE((interpolate<Basis>(grid, field, point + e) - interpolate<Basis>(grid, field, point - e)).norm() <
            1e-10);
    if (Basis::degree > 1)
      REQUIRE((gradient<Basis>(grid, field, point + e) - gradient<Basis>(grid, field, point - e)).norm() <
              1e-8);
  }
}

}  // namespace

TEST_CASE("basis functions sum to one and their gradients to zero everywhere") {
  const Scene scene =
      box(GENERATE(1, 2, 5), GENERATE(1, 2, 3, 7), GENERATE(true, false), GENERATE(true, false));
  require_partition_of_unity<LinearBasis>(scene);
  require_partition_of_unity<QuadraticBasis>(scene);
  require_partition_of_unity<CubicBasis>(scene);
}

TEST_CASE("a linear field between walls is reproduced, with its gradient") {
  const Scene scene = box(GENERATE(1, 2, 4), GENERATE(1, 3, 7), false, false);
  require_linear_reproduction<LinearBasis>(scene);
  require_linear_reproduction<QuadraticBasis>(scene);
  require_linear_reproduction<CubicBasis>(scene);
}

TEST_CASE("gradients are the derivatives of the values") {
  const Scene scene = box(GENERATE(1, 3), GENERATE(1, 2, 6), GENERATE(true, false), GENERATE(true, false));
  require_derivatives<LinearBasis>(scene);
  require_derivatives<QuadraticBasis>(scene);
  require_derivatives<CubicBasis>(scene);
}

TEST_CASE("fields are continuous across cell boundaries, and smooth for splines") {
  const Scene scene = box(2, GENERATE(2, 3, 8), GENERATE(true, false), GENERATE(true, false));
  require_continuity<LinearBasis>(scene);
  require_continuity<QuadraticBasis>(scene);
  require_continuity<CubicBasis>(scene);
}

TEST_CASE("far from walls the splines are the uniform ones") {
  const Axis between_walls(8, 8, false, 3), periodic(8, 8, true, 2);
  const auto cubic = CubicBasis::at(between_walls, 4.0);  // on a knot: 1/6, 2/3, 1/6, 0
  CHECK(cubic.value[0] == Approx(1.0 / 6));
  CHECK(cubic.value[1] == Approx(2.0 / 3));
  CHECK(cubic.value[2] == Approx(1.0 / 6));
  CHECK(std::abs(cubic.value[3]) < 1e-16);
  const auto quadratic = QuadraticBasis::at(periodic, 0.5);  // in the middle of a cell: 1/8, 3/4, 1/8
  CHECK(quadratic.value[0] == Approx(0.125));
  CHECK(quadratic.value[1] == Approx(0.75));
  CHECK(quadratic.value[2] == Approx(0.125));
}

TEST_CASE("on a wall its function alone differs from zero") {
  const Axis axis(0.3, 5, false, 3);
  const auto low = CubicBasis::at(axis, 0), high = CubicBasis::at(axis, 0.3);
  CHECK(low.value == std::array<double, 4>{1, 0, 0, 0});
  CHECK(high.value[3] == Approx(1).epsilon(1e-15));
  CHECK(std::abs(high.value[2]) < 1e-15);
  CHECK(axis.control_point(0) == 0);
  CHECK(axis.control_point(7) == 0.3);
}

TEST_CASE("the strip basis is the two-dimensional one with its images gathered") {
  const Scene scene = box(1, 6, true, false);
  const Grid grid(scene, 3);
  const VectorField field = rough_field(grid);
  for (const Vec2& point : probing_points(scene)) {
    // Round-off of values of order one and gradients of order 1/h = 10.
    REQUIRE((interpolate<CubicBasis>(grid, field, point) - interpolate<StripBSpline<3>>(grid, field, point))
                .norm() < 2e-15);
    REQUIRE(
        (gradient<CubicBasis>(grid, field, point) - gradient<StripBSpline<3>>(grid, field, point)).norm() <
        2e-13);
  }
}

TEST_CASE("periodic coordinates wrap, others report that they left") {
  const Scene scene = box(3, 5, true, false);
  const Grid grid(scene, 1);
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
