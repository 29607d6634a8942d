#include "solver/scene/seeding.hpp"

#include <algorithm>
#include <cmath>

#include "tests/catch.hpp"

using namespace mpm;

TEST_CASE("Gauss points integrate polynomials of degree 2n - 1, evenly spaced ones only linear functions") {
  const int n = GENERATE(1, 2, 3, 4, 5, 6);
  const CellPoints gauss = cell_points(Seeding::Rule::Gauss, n);
  REQUIRE(gauss.position.size() == static_cast<std::size_t>(n));
  for (int power = 0; power <= 2 * n; ++power) {
    double sum = 0;
    for (std::size_t k = 0; k < gauss.position.size(); ++k)
      sum += gauss.weight[k] * std::pow(gauss.position[k], power);
    const double error = std::abs(sum - 1.0 / (power + 1));
    if (power < 2 * n)
      CHECK(error < 1e-15);
    else
      CHECK(error > 1e-8);  // (n!)^4/((2n + 1) ((2n)!)^2) = 9e-8 at n = 6
  }
  const CellPoints even = cell_points(Seeding::Rule::Even, n);
  for (int i = 0; i < n; ++i) CHECK(even.position[static_cast<std::size_t>(i)] == Approx((i + 0.5) / n));
}

TEST_CASE("particles fill the scene's mass, whatever their places") {
  Scene scene;
  scene.size = {0.2, 0.7};
  scene.cells = {3, 4};
  scene.particles_per_cell = {GENERATE(1, 2, 6), GENERATE(1, 3, 6)};
  scene.seeding.rule = {Seeding::Rule::Even, GENERATE(Seeding::Rule::Even, Seeding::Rule::Gauss)};
  scene.seeding.displacement = GENERATE(0.0, 0.5);
  scene.side(Edge::Bottom) = scene.side(Edge::Top) = Side::wall(Vec2::Zero());
  const Particles particles = seed_particles(scene);
  REQUIRE(particles.size() ==
          static_cast<std::size_t>(12 * scene.particles_per_cell[0] * scene.particles_per_cell[1]));
  double mass = 0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    mass += particles.mass[p];
    REQUIRE((particles.position[p].array() >= 0).all());
    REQUIRE((particles.position[p].array() <= scene.size.array()).all());
  }
  CHECK(mass == Approx(1000 * 0.2 * 0.7).epsilon(1e-14));
}

TEST_CASE("a displacement stays within its reach, repeats with its seed and differs with another") {
  Scene scene;
  scene.size = {1, 1};
  scene.cells = {8, 8};
  const Particles lattice = seed_particles(scene);
  scene.seeding.displacement = 0.25;
  const Particles displaced = seed_particles(scene), again = seed_particles(scene);
  scene.seeding.seed = 2;
  const Particles other = seed_particles(scene);
  Vec2 mean = Vec2::Zero();
  double most = 0;
  for (std::size_t p = 0; p < lattice.size(); ++p) {
    const Vec2 d = displaced.position[p] - lattice.position[p];
    mean += d / static_cast<double>(lattice.size());
    most = std::max(most, d.cwiseAbs().maxCoeff());
  }
  CHECK(most <= 0.25 / 16);
  CHECK(most > 0.9 * 0.25 / 16);  // the largest of 512 uniform numbers: below 0.9 with probability 0.9^512
  CHECK(mean.norm() < 0.1 * 0.25 / 16);  // standard deviation 0.036 of the reach: three of them
  CHECK(displaced.position == again.position);
  CHECK_FALSE(displaced.position == other.position);
  // mt19937 is fixed by the standard: its first two numbers from seed 1 are 1791095845 and 4282876139.
  CHECK(displaced.position[0].x() == Approx((0.5 + 0.25 * (2 * 0.4170219986692967 - 1)) / 16).epsilon(1e-15));
}

TEST_CASE("on cells that are not square, displacement and shortest length are those of each axis") {
  Scene scene;
  scene.size = {0.8, 0.04};
  scene.cells = {8, 8};  // 0.1 by 0.005
  const Particles lattice = seed_particles(scene);
  scene.seeding.displacement = 0.25;
  const Particles displaced = seed_particles(scene);
  Vec2 most = Vec2::Zero();
  for (std::size_t p = 0; p < lattice.size(); ++p)
    most = most.cwiseMax((displaced.position[p] - lattice.position[p]).cwiseAbs());
  for (int axis : {0, 1}) {
    const double reach = 0.25 * scene.size[axis] / 16;
    CHECK(most[axis] <= reach);
    CHECK(most[axis] > 0.9 * reach);  // of 256 uniform numbers: below 0.9 with probability 0.9^256
  }
  CHECK(scene.smallest_cell_size() == Approx(0.005));
  scene.size = {0.04, 0.8};
  CHECK(scene.smallest_cell_size() == Approx(0.005));
}

TEST_CASE("the initial gradient is taken over a ten-thousandth of a cell along each axis") {
  Scene scene;
  scene.size = {1000, 1};
  scene.cells = {1, 1};
  scene.particles_per_cell = {3, 3};  // two would lie where the gradient is zero, whatever the step
  const double k = 2 * std::acos(-1.0);
  scene.initial_velocity = [k](const Vec2& x) { return Vec2(std::sin(k * x.y()), x.x()); };
  const Particles particles = seed_particles(scene);
  const std::vector<Mat2> gradients = initial_gradients(scene, particles);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double exact = k * std::cos(k * particles.position[p].y());
    // (k step)^2/6 = 6.6e-8 of it is lost; over a ten-thousandth of the other axis' cell 6 %.
    CHECK(std::abs(gradients[p](0, 1) - exact) < 2e-7 * k);
    CHECK(gradients[p](1, 0) == Approx(1).epsilon(1e-9));
  }
}
