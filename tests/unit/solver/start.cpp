#include "solver/scene/seeding.hpp"
#include "solver/simulation.hpp"
#include "tests/catch.hpp"

using namespace mpm;

// What a start must hand to particles that carry an affine field: on cells that are not square.

TEST_CASE("the gradient of an initial velocity, with all its components") {
  Scene scene;
  scene.size = {0.3, 0.7};
  scene.cells = {3, 4};
  Mat2 l;
  l << 2, -3, 5, 7;
  scene.initial_velocity = [l](const Vec2& x) -> Vec2 { return l * x; };
  // A central difference over 2e-4 of a cell: round-off of 1e-16/1e-5 relative to values of order one.
  for (const Mat2& gradient : initial_gradients(scene, seed_particles(scene)))
    CHECK((gradient - l).norm() < 1e-9);
}

TEST_CASE("APIC: an impulsive plate gives the particles beside it its share, and the gradient of that") {
  const int along = GENERATE(0, 1), across = 1 - along;
  Scene scene;
  scene.size = {0.6, 0.4};
  scene.cells = {3, 4};
  scene.fluid.pressure = false;
  scene.fluid.rheology = Newtonian{1};
  scene.side(along == 0 ? Edge::Bottom : Edge::Left) = Side::wall(Vec2::Zero());
  scene.side(along == 0 ? Edge::Top : Edge::Right) = Side::wall(along == 0 ? Vec2(2, 0) : Vec2(0, 2));
  Scheme scheme;
  scheme.transfer = Scheme::Transfer::Apic;
  const auto simulation = make_simulation(scene, scheme);
  const Particles& particles = simulation->particles();
  const double h = scene.cell_size(across), begin = scene.size[across] - h;
  int beside = 0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double share = std::max(0.0, (particles.position[p][across] - begin) / h);
    Mat2 expected = Mat2::Zero();
    if (share > 0) expected(along, across) = 2 / h, ++beside;
    CHECK(particles.velocity[p][along] == Approx(2 * share).epsilon(1e-12));
    CHECK((particles.affine[p] - expected).norm() < 1e-12 * 2 / h);
  }
  CHECK(beside == 2 * 2 * scene.cells[static_cast<std::size_t>(along)]);
}
