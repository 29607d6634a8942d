#include <cmath>
#include <numbers>

#include "solver/incompressible/make_incompressible_solver.hpp"
#include "solver/incompressible/pressure.hpp"
#include "solver/incompressible/pressure_field.hpp"
#include "solver/incompressible/space/exact_mass.hpp"
#include "solver/incompressible/stokes.hpp"
#include "solver/scene/seeding.hpp"
#include "tests/catch.hpp"

using namespace mpm;
using namespace mpm::incompressible;

namespace {

enum class Box { Walls, ChannelX, ChannelY, Periodic };

Scene box(Box kind, int cells = 6, double nu = 0.01) {
  Scene scene;
  scene.size = {1, 1.5};
  scene.cells = {cells, cells + 1};
  scene.particles_per_cell = {3, 3};
  scene.fluid.density = 2;
  scene.fluid.pressure = false;
  scene.fluid.rheology = Newtonian{nu * scene.fluid.density};
  for (const int axis : {0, 1}) {
    const bool wall =
        kind == Box::Walls || (kind == Box::ChannelX && axis == 1) || (kind == Box::ChannelY && axis == 0);
    if (!wall) continue;
    for (const int end : {0, 1}) scene.sides[static_cast<std::size_t>(2 * axis + end)] = Side::wall({0, 0});
  }
  return scene;
}

/// A vortex that fills a square box with walls, or a periodic one.
Scene vortex(int cells, bool walls) {
  Scene scene = box(walls ? Box::Walls : Box::Periodic, cells);
  scene.size = {1, 1};
  scene.cells = {cells, cells};
  scene.initial_velocity = [](const Vec2& x) {
    const double k = 2 * std::numbers::pi;
    return Vec2(std::sin(k * x.x()) * std::cos(k * x.y()), -std::cos(k * x.x()) * std::sin(k * x.y()));
  };
  return scene;
}

VectorXd arbitrary(Eigen::Index n) {
  VectorXd z(n);
  for (Eigen::Index i = 0; i < n; ++i) z[i] = std::sin(1.0 + 7.3 * static_cast<double>(i * i % 101));
  return z;
}

const std::vector<Vec2> scattered = {{0.013, 0.02},  {0.5, 0.75},  {0.37, 1.31},
                                     {0.999, 1.499}, {0.81, 0.44}, {1, 0}};

}  // namespace

TEST_CASE("splines sum to one, and their derivatives are those of the next lower degree",
          "[incompressible]") {
  for (const bool periodic : {false, true})
    for (const int k : {2, 3, 4}) {
      const SplineAxis axis(2.0, 7, periodic, k);
      const SparseMatrix derivative = axis.derivative();
      for (int cell = 0; cell < 7; ++cell)
        for (const double xi : {0.0, 0.3, 1.0}) {
          CHECK(axis.values(0, cell, xi).sum() == Approx(1).epsilon(1e-14));
          CHECK(axis.values(1, cell, xi).sum() == Approx(1).epsilon(1e-14));
          const VectorXd of_less = axis.values(1, cell, xi);
          const VectorXd slopes = MatrixXd(derivative).block(cell, cell, k, k + 1).transpose() * of_less;
          CHECK((slopes - axis.slopes(0, cell, xi)).norm() < 1e-12);
        }
      CHECK(axis.integrals(0).sum() == Approx(2));
    }
}

TEST_CASE("solenoidal velocities have no divergence at any point, whatever the sides", "[incompressible]") {
  for (const Box kind : {Box::Walls, Box::ChannelX, Box::ChannelY, Box::Periodic})
    for (const int k : {2, 3, 4}) {
      const Scene scene = box(kind);
      const VelocitySpace space(scene, k);
      const SparseMatrix basis = space.solenoidal_basis();
      const VelocityField field = space.extended(basis * arbitrary(basis.cols()));
      for (const Vec2& x : scattered) {
        const Mat2 l = space.gradient(field, x);
        CHECK(std::abs(l.trace()) < 1e-12 * (1 + l.norm()));
      }
      // As many as velocities less the pressures that bind them (constants bind nothing).
      const Eigen::Index pressures =
          static_cast<Eigen::Index>(space.axis(0).tangential().count) * space.axis(1).tangential().count - 1;
      CHECK(basis.cols() == space.size() - pressures);
    }
}

TEST_CASE("normal velocities vanish on walls", "[incompressible]") {
  const Scene scene = box(Box::Walls);
  const VelocitySpace space(scene, 3);
  const VelocityField field = space.extended(arbitrary(space.size()));
  for (const double s : {0.0, 0.21, 0.5, 1.0}) {
    CHECK(std::abs(space.value(field, {0, 1.5 * s}).x()) < 1e-14);
    CHECK(std::abs(space.value(field, {1, 1.5 * s}).x()) < 1e-14);
    CHECK(std::abs(space.value(field, {s, 0}).y()) < 1e-14);
    CHECK(std::abs(space.value(field, {s, 1.5}).y()) < 1e-14);
  }
}

TEST_CASE("the exact mass inverts itself, and weighs a uniform field", "[incompressible]") {
  for (const Box kind : {Box::Walls, Box::ChannelX, Box::Periodic}) {
    const VelocitySpace space(box(kind), 3);
    const ExactMass mass(space);
    const VectorXd z = arbitrary(space.size());
    CHECK((mass.solved(mass.times(z)) - z).norm() < 1e-11 * z.norm());
    CHECK((mass.matrix() * z - mass.times(z)).norm() < 1e-13 * z.norm());
    if (kind == Box::Periodic) CHECK(mass.times(VectorXd::Ones(space.size())).sum() == Approx(2 * 1.5));
  }
}

TEST_CASE("Stokes flow in a channel: the parabola stands, and its rise is of second order",
          "[incompressible]") {
  Scene scene = box(Box::ChannelX, 8, 0.5);
  scene.body_acceleration = [](double) { return Vec2(0.3, 0); };
  const VelocitySpace space(scene, 3);
  const ExactMass mass(space);
  Stokes stokes(scene, space, mass);
  VectorXd u = VectorXd::Zero(space.size());
  for (int i = 0; i < 40; ++i)
    u = stokes.advanced(u, i * 0.5, 0.5, IncompressibleScheme::Stepping::Sdirk2).end;
  const auto steady = [](double y) { return 0.3 / (2 * 0.5) * y * (1.5 - y); };
  for (const double y : {0.1, 0.4, 0.75, 1.2})
    CHECK(space.value(space.extended(u), {0.3, y}).x() == Approx(steady(y)).epsilon(1e-10));

  for (const auto rule : {IncompressibleScheme::Stepping::Midpoint, IncompressibleScheme::Stepping::Sdirk2}) {
    std::vector<VectorXd> at_end;
    for (const int steps : {40, 80, 160}) {
      VectorXd w = VectorXd::Zero(space.size());
      const double dt = 0.4 / steps;
      for (int i = 0; i < steps; ++i) w = stokes.advanced(w, i * dt, dt, rule).end;
      at_end.push_back(w);
    }
    const double order = std::log2((at_end[1] - at_end[0]).norm() / (at_end[2] - at_end[1]).norm());
    CHECK(order == Approx(2).margin(0.15));
  }
}

TEST_CASE("a plate drags the fluid linearly, and the impulse on it is accounted for", "[incompressible]") {
  Scene scene = box(Box::ChannelX, 8, 0.5);
  scene.side(Edge::Top) = Side::wall({0.7, 0});
  const VelocitySpace space(scene, 3);
  const ExactMass mass(space);
  Stokes stokes(scene, space, mass);
  VectorXd u = VectorXd::Zero(space.size());
  Vec2 impulse = Vec2::Zero();
  for (int i = 0; i < 60; ++i) {
    const auto step = stokes.advanced(u, i * 0.5, 0.5, IncompressibleScheme::Stepping::Sdirk2);
    u = step.end;
    impulse += step.impulse;
  }
  for (const double y : {0.1, 0.75, 1.4})
    CHECK(space.value(space.extended(u), {0.3, y}).x() == Approx(0.7 * y / 1.5).epsilon(1e-10));
  CHECK(impulse.x() == Approx(0.7 / 2 * 1.5).epsilon(1e-9));  // the fluid's momentum at the end, per density
}

TEST_CASE("the vortex: solenoidal where particles drift, spread, conserving, the same bits by any threads",
          "[incompressible]") {
  const Scene scene = vortex(12, false);
  IncompressibleScheme scheme;
  const auto one = make_incompressible_solver(scene, scheme, 1),
             three = make_incompressible_solver(scene, scheme, 3);
  const Vec2 momentum = one->totals().momentum;
  for (int i = 0; i < 20; ++i) {
    one->advance(i * 0.02, 0.02);
    three->advance(i * 0.02, 0.02);
  }
  CHECK(one->particles().position == three->particles().position);
  CHECK(one->particles().velocity == three->particles().velocity);
  CHECK((one->totals().momentum - momentum).norm() < 1e-12 * one->totals().mass);
  for (const Mat2& l : one->grid_gradient(one->particles().position, 0.4)) CHECK(std::abs(l.trace()) < 1e-11);
  CHECK_FALSE(one->breakdown());
}

TEST_CASE("a field that blows up is a breakdown", "[incompressible]") {
  Scene scene = vortex(8, true);
  scene.initial_velocity = [](const Vec2& x) { return Vec2(x.y() - 0.5, 0.5 - x.x()); };
  const auto simulation = make_incompressible_solver(scene, {}, 1);
  simulation->advance(0, 100);
  REQUIRE(simulation->breakdown().has_value());
  CHECK_THAT(*simulation->breakdown(), contains("whole domain in a step"));
}

TEST_CASE("what the incompressible method does not know is refused", "[incompressible]") {
  Scene scene = box(Box::Walls);
  IncompressibleScheme scheme;
  scheme.degree = 5;
  CHECK_THROWS_WITH(require_incompressible_fits(scheme, scene), contains("degree"));
  scheme.degree = 3;
  scene.side(Edge::Top) = Side::wall({0, 1});
  CHECK_THROWS_WITH(require_incompressible_fits(scheme, scene), contains("along itself"));
}

TEST_CASE("a pressure is told from what it does to velocities, up to a constant", "[incompressible]") {
  for (const Box kind : {Box::Walls, Box::ChannelX, Box::Periodic}) {
    const VelocitySpace space(box(kind, 8), 3);
    const Pressure pressure(space);
    // integral of p div N for p = (x - 1/2) y: -b on velocities, b = grad p, where nothing is periodic.
    const VectorXd load = -space.load([](const VectorField& points, VectorField& values) {
      for (std::size_t i = 0; i < points.size(); ++i) values[i] = {points[i].y(), points[i].x() - 0.5};
    });
    const MatrixXd p = pressure.balancing(load);
    if (kind == Box::Walls)
      for (const Vec2& x : scattered)
        CHECK(pressure.value(p, x) == Approx((x.x() - 0.5) * x.y()).margin(1e-11));
    // Solenoidal forces ask for none.
    const SparseMatrix basis = space.solenoidal_basis();
    const ExactMass mass(space);
    const VectorXd solenoidal = basis * arbitrary(basis.cols());
    CHECK((space.divergence() * solenoidal).norm() < 1e-10 * solenoidal.norm());
  }
}

TEST_CASE("gravity in a closed box is borne by the pressure", "[incompressible]") {
  Scene scene = box(Box::Walls, 6);
  scene.body_acceleration = [](double) { return Vec2(0, -9.81); };
  const auto simulation = make_incompressible_solver(scene, {}, 1);
  const auto& field = dynamic_cast<const PressureField&>(*simulation);
  CHECK(field.grid_pressure({{0.5, 0.5}}).empty());
  for (int i = 0; i < 3; ++i) simulation->advance(i * 0.1, 0.1);
  const std::vector<double> p = field.grid_pressure({{0.2, 0.1}, {0.7, 1.4}});
  CHECK(p[0] == Approx(2 * 9.81 * 0.65).epsilon(1e-9));
  CHECK(p[1] == Approx(-2 * 9.81 * 0.65).epsilon(1e-9));
}

namespace {

/// Velocities of a box at rest after some steps of a lid that moves with 16 x^2 (1 - x)^2.
template <class Law>
VectorField under_smooth_lid(const Law& law) {
  Scene scene = box(Box::Walls, 8);
  scene.size = {1, 1};
  scene.cells = {8, 8};
  scene.fluid.rheology = law;
  scene.side(Edge::Top) = Side::wall({1, 0});
  WallShares shares;
  shares[static_cast<std::size_t>(Edge::Top)] = [](double x) { return 16 * x * x * (1 - x) * (1 - x); };
  const auto simulation = make_incompressible_solver(scene, {}, 1, shares);
  for (int i = 0; i < 40; ++i) simulation->advance(i * 0.05, 0.05);
  VectorField points;
  for (const double x : {0.1, 0.3, 0.5, 0.8}) points.emplace_back(x, 1.0);
  return simulation->grid_field(points, 2);
}

}  // namespace

TEST_CASE("a wall whose velocity varies along it moves the fluid so, Newtonian or not", "[incompressible]") {
  const VectorField newtonian = under_smooth_lid(Newtonian{0.02});
  // The same fluid as a power law of index 1 and as one that yields to nothing: the other texts of the
  // viscosity.
  const VectorField general = under_smooth_lid(PowerLaw{0.02, 1.0, 1e-6, 1});
  const VectorField yielding = under_smooth_lid(HerschelBulkley{0.02, 1.0, 1e-12, 10, 1e-6, 1});
  const double x[] = {0.1, 0.3, 0.5, 0.8};
  for (std::size_t i = 0; i < newtonian.size(); ++i) {
    CHECK(newtonian[i].x() ==
          Approx(16 * std::pow(x[i] * (1 - x[i]), 2)).margin(0.044));  // held weakly: 0.022
    CHECK((newtonian[i] - general[i]).norm() < 1e-7);
    CHECK((newtonian[i] - yielding[i]).norm() < 1e-7);
  }
}
