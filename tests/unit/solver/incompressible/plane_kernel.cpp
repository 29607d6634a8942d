#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "solver/incompressible/lanes/plane_setup.hpp"
#include "solver/incompressible/space/exact_mass.hpp"
#include "solver/kernel/isa.hpp"
#include "solver/scene/seeding.hpp"
#include "tests/catch.hpp"

using namespace mpm;
using namespace mpm::incompressible;

namespace {

/// Between walls along neither axis, one of them, or both.
Scene box(bool walls_x, bool walls_y, int cells_x, int cells_y) {
  Scene scene;
  scene.size = {1, 1.5};
  scene.cells = {cells_x, cells_y};
  scene.particles_per_cell = {3, 2};
  for (const int end : {0, 1}) {
    if (walls_x) scene.sides[static_cast<std::size_t>(end)] = Side::wall({0, 0});
    if (walls_y) scene.sides[static_cast<std::size_t>(2 + end)] = Side::wall({0, 0});
  }
  return scene;
}

double arbitrary(std::size_t i) {
  return std::sin(1.0 + 7.3 * static_cast<double>(i * i % 101));
}
VectorXd arbitrary_field(Eigen::Index n) {
  VectorXd z(n);
  for (Eigen::Index i = 0; i < n; ++i) z[i] = arbitrary(static_cast<std::size_t>(i));
  return z;
}

/// Particles of unequal volumes out of their lattice, crowded towards one corner.
struct Crowd {
  VectorField place, velocity;
  std::vector<double> volume;

  explicit Crowd(const Scene& scene) : place(seed_particles(scene).position) {
    for (std::size_t p = 0; p < place.size(); ++p) {
      for (const int a : {0, 1}) {
        const double s = place[p][a] / scene.size[a];
        place[p][a] = scene.size[a] * s * (0.9 + 0.1 * s * arbitrary(2 * p + static_cast<std::size_t>(a)));
      }
      velocity.emplace_back(arbitrary(3 * p), arbitrary(3 * p + 1));
      volume.push_back((1 + 0.3 * arbitrary(5 * p)) * scene.size.prod() / static_cast<double>(place.size()));
    }
  }
};

VectorXd fitted(PlaneKernel& kernel, const VelocitySpace& space, const Crowd& crowd, const VectorXd& last,
                ThreadTeam& team) {
  kernel.assemble(crowd.volume.data(), crowd.place[0].data(), crowd.velocity[0].data(), crowd.place.size(),
                  team);
  VectorXd result(space.size());
  kernel.solve(0, 1e-13, last.data(), result.data());
  kernel.solve(1, 1e-13, last.data() + space.size(0), result.data() + space.size(0));
  return result;
}

/// The normal equations of the fit, unknown by unknown.
VectorXd fitted_densely(const VelocitySpace& space, const Crowd& crowd, const VectorXd& last, double r) {
  MatrixXd values(2 * static_cast<Eigen::Index>(crowd.place.size()), space.size());
  VectorXd weight(values.rows()), asked(values.rows());
  for (Eigen::Index n = 0; n < space.size(); ++n) {
    const VelocityField unit = space.extended(VectorXd::Unit(space.size(), n));
    for (std::size_t p = 0; p < crowd.place.size(); ++p)
      values.col(n).segment<2>(2 * static_cast<Eigen::Index>(p)) = space.value(unit, crowd.place[p]);
  }
  for (std::size_t p = 0; p < crowd.place.size(); ++p) {
    weight.segment<2>(2 * static_cast<Eigen::Index>(p)).setConstant(crowd.volume[p]);
    asked.segment<2>(2 * static_cast<Eigen::Index>(p)) = crowd.velocity[p];
  }
  const MatrixXd mass = ExactMass(space).matrix();
  const MatrixXd matrix = values.transpose() * weight.asDiagonal() * values + r * mass;
  return matrix.ldlt().solve(values.transpose() * (weight.asDiagonal() * asked) + r * (mass * last));
}

}  // namespace

TEST_CASE("the vector kernels fit and follow fields as their definitions say, on every instruction set",
          "[incompressible][lanes]") {
  const auto [walls_x, walls_y] = GENERATE(std::pair(false, false), std::pair(true, false),
                                           std::pair(false, true), std::pair(true, true));
  const auto [cells_x, cells_y] = GENERATE(std::pair(1, 9), std::pair(9, 2), std::pair(11, 5));
  const int k = GENERATE(2, 3, 4);
  const Scene scene = box(walls_x, walls_y, cells_x, cells_y);
  const VelocitySpace space(scene, k);
  const VectorXd z = arbitrary_field(space.size());
  const VelocityField field = space.extended(z);
  const Crowd crowd(scene);
  const double r = 1e-3;
  const PlaneSetup setup = plane_setup(space, r);
  const VectorXd expected = fitted_densely(space, crowd, z, r);
  const auto inside = [&](Vec2 x) {
    for (const int a : {0, 1})
      x[a] = scene.periodic(a) ? x[a] - scene.size[a] * std::floor(x[a] / scene.size[a])
                               : std::clamp(x[a], 0.0, scene.size[a]);
    return x;
  };
  for (const std::string& isa : available_isas()) {
    INFO(isa << " k = " << k << ", " << cells_x << " x " << cells_y << ", walls " << walls_x << walls_y);
    use_isa(isa);
    const std::unique_ptr<PlaneKernel> kernel = make_plane_kernel(setup);
    ThreadTeam one(1), three(3);
    const VectorXd found = fitted(*kernel, space, crowd, z, one);
    CHECK((found - expected).lpNorm<Eigen::Infinity>() < 1e-8 * expected.lpNorm<Eigen::Infinity>());
    CHECK(fitted(*kernel, space, crowd, z, three) == found);

    kernel->follow(z.data());
    VectorField velocity(crowd.place.size()), end(crowd.place.size());
    kernel->velocities(crowd.place[0].data(), crowd.place.size(), velocity[0].data());
    const double dt = 0.05;
    kernel->drift(crowd.place[0].data(), crowd.place.size(), dt, end[0].data());
    double missed = 0, astray = 0;
    for (std::size_t p = 0; p < crowd.place.size(); ++p) {
      const Vec2 v = space.value(field, crowd.place[p]);
      missed = std::max(missed, (velocity[p] - v).norm());
      const Vec2 middle = inside(crowd.place[p] + 0.5 * dt * v);
      astray = std::max(astray, (end[p] - inside(crowd.place[p] + dt * space.value(field, middle))).norm());
    }
    CHECK(missed < 1e-13);
    CHECK(astray < 1e-13);
  }
  use_isa(available_isas().back());
}

TEST_CASE("the fit gives back what the grid can carry, and counts who is where", "[incompressible][lanes]") {
  const Scene scene = box(true, true, 20, 21);
  const VelocitySpace space(scene, 3);
  const VectorXd z = arbitrary_field(space.size());
  const VelocityField field = space.extended(z);
  Crowd crowd(scene);
  crowd.place = seed_particles(scene).position;
  for (std::size_t p = 0; p < crowd.place.size(); ++p) crowd.velocity[p] = space.value(field, crowd.place[p]);
  ThreadTeam team(1);
  const PlaneSetup setup = plane_setup(space, 1e-5);
  const std::unique_ptr<PlaneKernel> kernel = make_plane_kernel(setup);
  CHECK((fitted(*kernel, space, crowd, z, team) - z).lpNorm<Eigen::Infinity>() < 1e-9);
  // Held to nothing by a hundred-thousandth.
  CHECK(fitted(*kernel, space, crowd, VectorXd::Zero(z.size()), team).isApprox(z, 1e-3));
  CHECK(kernel->occupancy() == std::pair{6, 6});
}
