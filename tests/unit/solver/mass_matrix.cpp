#include <Eigen/Cholesky>
#include <cmath>

#include "solver/grid/matrices/cholesky.hpp"
#include "solver/grid/matrices/conjugate_gradients.hpp"
#include "solver/grid/matrices/stencil_matrix.hpp"
#include "solver/grid/matrices/tensor_mass.hpp"
#include "solver/grid/stencil.hpp"
#include "solver/scene/seeding.hpp"
#include "tests/catch.hpp"

using namespace mpm;

namespace {

Scene box(int nx, int ny, bool walls) {
  Scene scene;
  scene.size = {0.4 * nx, 0.3 * ny};
  scene.cells = {nx, ny};
  scene.particles_per_cell = {4, 4};
  scene.seeding.rule = {Seeding::Rule::Gauss, Seeding::Rule::Gauss};  // integrates the mass matrix exactly
  if (walls) {
    scene.side(Edge::Bottom) = scene.side(Edge::Top) = Side::wall(Vec2::Zero());
  }
  return scene;
}

VectorField rough(std::size_t size) {
  VectorField field(size);
  for (std::size_t i = 0; i < size; ++i)
    field[i] = {std::sin(3.0 * static_cast<double>(i)), std::cos(2.0 * static_cast<double>(i))};
  return field;
}

Eigen::MatrixXd dense(const StencilMatrix& matrix) {
  const auto n = static_cast<Eigen::Index>(matrix.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  matrix.for_each([&](int row, int column, double entry) { a(row, column) += entry; });
  return a;
}

template <class Basis>
void check_matrix(int nx, int ny, bool walls) {
  Scene scene = box(nx, ny, walls);
  const Grid grid(scene, Basis::degree);
  Particles particles = seed_particles(scene);
  StencilMatrix matrix(grid);
  matrix.assemble<Basis>(grid, particles);
  const Eigen::MatrixXd a = dense(matrix);

  // Entry by entry from its definition.
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(a.rows(), a.cols());
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Stencil<Basis> stencil(grid, particles.position[p]);
    stencil.values([&](std::size_t i, double n_i) {
      stencil.values([&](std::size_t j, double n_j) {
        expected(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) += particles.mass[p] * n_i * n_j;
      });
    });
  }
  // Sums of at most 16 x 16 terms in another order.
  CHECK((a - expected).cwiseAbs().maxCoeff() < 1e-13 * expected.maxCoeff());

  const VectorField field = rough(grid.size());
  VectorField product;
  matrix.multiply(field, product);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>> v(
      field.front().data(), static_cast<Eigen::Index>(field.size()), 2);
  const Eigen::MatrixX2d reference = expected * v;
  for (std::size_t i = 0; i < field.size(); ++i)
    CHECK((product[i] - reference.row(static_cast<Eigen::Index>(i)).transpose()).norm() <
          1e-13 * expected.rowwise().sum().maxCoeff());

  // Uniform density and exact sums: the tensor product is the matrix, and its inverse the inverse.
  TensorMass tensor(grid);
  VectorField solution = product;
  tensor.solve(solution);
  for (std::size_t i = 0; i < field.size(); ++i) {
    CHECK(tensor.diagonal(i) * 1000 == Approx(a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i))));
    CHECK((solution[i] / 1000 - field[i]).norm() < 1e-11);  // condition number up to 400 for cubic splines
  }
}

}  // namespace

TEST_CASE("stencil matrix: entries, products and the tensor product of a uniform fluid") {
  const bool walls = GENERATE(false, true);
  check_matrix<BSpline<1>>(5, 4, walls);
  check_matrix<BSpline<2>>(6, 7, walls);
  check_matrix<BSpline<3>>(9, 8, walls);
  // Narrower than the stencil: images of a node couple with it more than once.
  check_matrix<BSpline<1>>(2, 3, walls);
  check_matrix<BSpline<2>>(3, 2, walls);
  check_matrix<BSpline<3>>(4, 3, walls);
}

TEST_CASE("conjugate gradients solve for both components, one of which may be nothing") {
  Eigen::Matrix3d a;
  a << 4, 1, 0, 1, 3, -1, 0, -1, 5;
  const auto multiply = [&](const VectorField& v, VectorField& product) {
    for (int i = 0; i < 3; ++i) {
      product[static_cast<std::size_t>(i)].setZero();
      for (int j = 0; j < 3; ++j)
        product[static_cast<std::size_t>(i)] += a(i, j) * v[static_cast<std::size_t>(j)];
    }
  };
  const auto precondition = [&](const VectorField& r, VectorField& z) {
    for (std::size_t i = 0; i < 3; ++i)
      z[i] = r[i] / a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
  };
  const VectorField b = {{1, 0}, {2, 0}, {-1, 0}};
  VectorField v(3, Vec2::Zero());
  conjugate_gradients(multiply, precondition, b, v, 1e-15, 10);
  const Eigen::Vector3d exact = a.llt().solve(Eigen::Vector3d(1, 2, -1));
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(v[i].x() == Approx(exact[static_cast<Eigen::Index>(i)]).epsilon(1e-14));
    CHECK(v[i].y() == 0);
  }
}

TEST_CASE("a positive definite matrix is the product of its triangles, another is refused") {
  Eigen::Matrix3d a;
  a << 4, 1, 0.5, 1, 3, -1, 0.5, -1, 5;
  const Eigen::MatrixXd lower = cholesky_factor(a);
  CHECK(lower.isLowerTriangular(0));
  // Round-off of three products of numbers up to five.
  CHECK((lower * lower.transpose() - a).cwiseAbs().maxCoeff() < 1e-14);
  const Eigen::Vector3d x(1, -2, 0.25);
  CHECK((solve_positive_definite(a, a * x) - x).cwiseAbs().maxCoeff() < 1e-14);
  a(2, 2) = -5;
  CHECK_THROWS_AS(cholesky_factor(a), SceneError);
  CHECK_THROWS_AS(solve_positive_definite(a, x), SceneError);
}
