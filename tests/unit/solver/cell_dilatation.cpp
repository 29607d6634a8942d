#include <cmath>
#include <numbers>

#include "solver/kernel/isa.hpp"
#include "solver/simulation.hpp"
#include "solver/table/make_solver.hpp"
#include "tests/catch.hpp"

using namespace mpm;

namespace {

/// A box of fluid that a lid stirs, two particles a cell and axis, disordered.
Scene stirred_box(int nx, int ny) {
  Scene scene;
  scene.size = {1e-3 * nx / 8, 1e-3 * ny / 8};
  scene.cells = {nx, ny};
  for (Side& side : scene.sides) side = Side::wall(Vec2::Zero());
  scene.side(Edge::Top) = Side::wall(Vec2(0.05, 0));
  scene.seeding.displacement = 0.3;
  scene.fluid.rheology = Newtonian{1e-3};
  return scene;
}

void run_steps(Simulation& simulation, double dt, int steps) {
  for (int k = 0; k < steps; ++k) simulation.advance(k * dt, dt);
}

}  // namespace

TEST_CASE("cell dilatation: particles of a cell share one density, and volume follows the walls") {
  const Scene scene = stirred_box(7, 6);
  Scheme scheme;
  scheme.transfer = GENERATE(Scheme::Transfer::Flip, Scheme::Transfer::Apic);
  scheme.stepping = Scheme::Stepping::Usl;
  scheme.dilatation = Scheme::Dilatation::Cell;
  const auto simulation = make_simulation(scene, scheme);
  run_steps(*simulation, 1e-5, 300);
  // Particles were in these cells before the last move, in which few crossed: most of a cell agree.
  const Particles& p = simulation->particles();
  double volume = 0;
  for (std::size_t k = 0; k < p.size(); ++k) volume += p.mass[k] / p.density[k];
  // The sum over cells of V_c div_c dt is the flux through resting walls, zero to the unevenness of V_c.
  CHECK(std::abs(volume / (scene.size.x() * scene.size.y()) - 1) < 1e-2);
  int alike = 0;
  for (std::size_t k = 1; k < p.size(); ++k) alike += p.density[k] == p.density[k - 1] ? 1 : 0;
  CHECK(alike > static_cast<int>(p.size()) / 3);
  CHECK_FALSE(simulation->breakdown());
}

TEST_CASE("cell dilatation: a uniform dilatation is that of every particle") {
  Scene scene;
  scene.cells = {6, 5};
  scene.size = {6e-4, 5e-4};
  const double rate = -40;
  scene.side(Edge::Left) = scene.side(Edge::Right) = Side::wall(Vec2::Zero());
  scene.side(Edge::Right) = Side::wall(Vec2(rate * scene.size.x(), 0));
  scene.initial_velocity = [=](const Vec2& x) { return Vec2(rate * x.x(), 0); };
  scene.fluid.bulk_modulus = 1e-6;
  Scheme of_particle, of_cell;
  of_cell.dilatation = Scheme::Dilatation::Cell;
  const auto a = make_simulation(scene, of_particle), b = make_simulation(scene, of_cell);
  const double dt = 1e-6;
  a->advance(0, dt);
  b->advance(0, dt);
  for (std::size_t p = 0; p < a->particles().size(); ++p)
    CHECK(std::abs(b->particles().density[p] / a->particles().density[p] - 1) < 1e-13);
}

TEST_CASE("cell dilatation: vector kernels give what the general solver gives") {
  for (const auto basis : {Scheme::Basis::Linear, Scheme::Basis::Quadratic, Scheme::Basis::Cubic})
    for (const auto stepping : {Scheme::Stepping::Usf, Scheme::Stepping::Usl, Scheme::Stepping::Musl})
      for (const std::string& isa : available_isas()) {
        use_isa(isa);
        const Scene scene = stirred_box(11, 6);
        Scheme scheme{basis, Scheme::Transfer::FlipBlend, stepping};
        scheme.dilatation = Scheme::Dilatation::Cell;
        const auto lanes = make_simulation(scene, scheme);
        const auto plain = make_general_solver(scene, scheme);
        run_steps(*lanes, 1e-5, 60);
        run_steps(*plain, 1e-5, 60);
        double position = 0, density = 0;
        for (std::size_t p = 0; p < plain->particles().size(); ++p) {
          position =
              std::max(position, (lanes->particles().position[p] - plain->particles().position[p]).norm());
          density =
              std::max(density, std::abs(lanes->particles().density[p] / plain->particles().density[p] - 1));
        }
        INFO(name(basis) << " " << name(stepping) << " " << isa);
        CHECK(position < 1e-11 * scene.size.x());
        CHECK(density < 1e-11);
      }
  use_isa(available_isas().back());
}

TEST_CASE("cell dilatation: what it cannot go with is refused") {
  Scheme scheme;
  scheme.dilatation = Scheme::Dilatation::Cell;
  Scene scene = stirred_box(3, 3);
  scene.fluid.pressure = false;
  CHECK_THROWS_WITH(make_simulation(scene, scheme), contains("pressure"));
  scheme.transfer = Scheme::Transfer::FullMass;
  scheme.stepping = Scheme::Stepping::Leapfrog;
  CHECK_THROWS_WITH(scheme.validate(), contains("full-mass"));
  CHECK_THROWS_WITH(dilatation_named("node"), contains("particle, cell"));
}
