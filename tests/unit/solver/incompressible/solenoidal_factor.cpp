#include "solver/incompressible/space/solenoidal_factor.hpp"

#include <cmath>
#include <limits>

#include "solver/incompressible/viscosity/viscous_form.hpp"
#include "tests/catch.hpp"

using namespace mpm;
using namespace mpm::incompressible;

namespace {

Scene periodic_box(int along_x, int along_y) {
  Scene scene;
  scene.size = {1, 1.5};
  scene.cells = {along_x, along_y};
  return scene;
}

VectorXd arbitrary(Eigen::Index n) {
  VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) values[i] = std::sin(1.0 + 7.3 * static_cast<double>(i * i % 101));
  return values;
}

}  // namespace

TEST_CASE("Fourier modes solve what Cholesky's factor solves where no side is a wall", "[incompressible]") {
  const auto [x, y] = GENERATE(std::pair(1, 1), std::pair(1, 5), std::pair(2, 2), std::pair(4, 3),
                               std::pair(8, 11), std::pair(13, 16));
  const int k = GENERATE(2, 3, 4);
  const Scene scene = periodic_box(x, y);
  const VelocitySpace space(scene, k);
  const ExactMass mass(space);
  const SparseMatrix basis = space.solenoidal_basis();
  const SparseMatrix reduced = (basis.transpose() * mass.matrix() * basis).pruned();
  const SparseMatrix viscous = (basis.transpose() * ViscousForm(space, scene).matrix() * basis).pruned();
  const VectorXd load = arbitrary(basis.cols());
  for (const double a_nu : {0.0, 1e-3, 1.0}) {
    const SparseMatrix matrix = reduced + a_nu * viscous;
    const VectorXd expected = Eigen::SimplicialLLT<SparseMatrix>(matrix).solve(load);
    const VectorXd found = SolenoidalFactor(space, matrix).solve(load);
    // Conditions up to some 1e6 here, times round-off.
    CHECK((found - expected).norm() < 1e-9 * expected.norm());
    CHECK((matrix * found - load).norm() < 1e-11 * load.norm());
  }
}

TEST_CASE("the modes of both lines solve what Cholesky's factor solves between four walls",
          "[incompressible]") {
  const auto [x, y] = GENERATE(std::pair(1, 1), std::pair(4, 3), std::pair(9, 16));
  const int k = GENERATE(2, 3, 4);
  Scene scene = periodic_box(x, y);
  for (Side& side : scene.sides) side = Side::wall({0, 0});
  scene.sides[1].slip_length = 0.1;
  scene.sides[3].slip_length = std::numeric_limits<double>::infinity();
  const VelocitySpace space(scene, k);
  const SparseMatrix basis = space.solenoidal_basis();
  const SparseMatrix reduced = (basis.transpose() * ExactMass(space).matrix() * basis).pruned();
  const ViscousForm form(space, scene);
  const SparseMatrix viscous = (basis.transpose() * form.matrix() * basis).pruned();
  const VectorXd load = arbitrary(basis.cols());
  CHECK((reduced * SolenoidalFactor(space, reduced).solve(load) - load).norm() < 1e-11 * load.norm());
  for (const double a_nu : {1e-6, 1e-3, 1.0, 1e3}) {
    const SparseMatrix matrix = reduced + a_nu * viscous;
    const VectorXd expected = Eigen::SimplicialLLT<SparseMatrix>(matrix).solve(load);
    const VectorXd found = SolenoidalFactor(space, matrix, Diffusion{a_nu, form.held()}).solve(load);
    CHECK((found - expected).norm() < 1e-9 * expected.norm());
    // Conditions up to some 1e7 here, times round-off.
    CHECK((matrix * found - load).norm() < 1e-10 * load.norm());
  }
}

TEST_CASE("a load that is not a number has no solution between four walls", "[incompressible]") {
  Scene scene = periodic_box(4, 3);
  for (Side& side : scene.sides) side = Side::wall({0, 0});
  const VelocitySpace space(scene, 3);
  const SparseMatrix basis = space.solenoidal_basis();
  const SparseMatrix reduced = (basis.transpose() * ExactMass(space).matrix() * basis).pruned();
  const ViscousForm form(space, scene);
  VectorXd load = arbitrary(basis.cols());
  load[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(!SolenoidalFactor(space, reduced).solve(load).allFinite());
  const SolenoidalFactor factor(space, reduced, Diffusion{0.1, form.held()});
  CHECK(!factor.solve(load).allFinite());
  CHECK(factor.solve(VectorXd::Zero(load.size())) == VectorXd::Zero(load.size()));
}

TEST_CASE("a matrix that is not positive definite is refused", "[incompressible]") {
  const Scene scene = periodic_box(4, 5);
  const VelocitySpace space(scene, 3);
  const SparseMatrix basis = space.solenoidal_basis();
  const SparseMatrix mass = (basis.transpose() * ExactMass(space).matrix() * basis).pruned();
  CHECK_THROWS_AS(SolenoidalFactor(space, -1 * mass), SceneError);
}
