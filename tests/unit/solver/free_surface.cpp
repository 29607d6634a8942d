#include <cmath>
#include <limits>
#include <memory>

#include "reference/compressible/tait_column.hpp"
#include "solver/simulation.hpp"
#include "solver/table/make_solver.hpp"
#include "tests/catch.hpp"

using namespace mpm;

namespace {

constexpr double slips_freely = std::numeric_limits<double>::infinity();

/// A tank, `nx` by `ny` cells of 1/16 m, with water of Mach number 0.1 up to height 1 in hydrostatic
/// equilibrium where is_fluid says so.
Scene tank(int nx, int ny, double slip_length, std::function<bool(const Vec2&)> is_fluid) {
  Scene scene;
  scene.size = {nx / 16.0, ny / 16.0};
  scene.cells = {nx, ny};
  for (Side& side : scene.sides) side = Side::wall(Vec2::Zero(), slip_length);
  scene.fluid.bulk_modulus = 1000 * 100 / 7.0;  // c = 10 m/s
  scene.fluid.rheology = Newtonian{1};
  scene.body_acceleration = [](double) { return Vec2(0, -1); };
  scene.free_surface = FreeSurface{std::move(is_fluid)};
  const reference::TaitColumn column({1, 1, 10, 1000});
  scene.initial_density = [column](const Vec2& x) { return column.density(x.y()); };
  return scene;
}

Scheme cells_with(Scheme::Transfer transfer) {
  Scheme scheme;
  scheme.transfer = transfer;
  scheme.dilatation = Scheme::Dilatation::Cell;
  return scheme;
}

double largest_speed(const Simulation& simulation) {
  double largest = 0;
  for (const Vec2& v : simulation.particles().velocity) largest = std::max(largest, v.norm());
  return largest;
}

/// Kinetic, potential and elastic energy per unit depth [J/m].
double energy(const Simulation& simulation, const Scene& scene) {
  const Particles& p = simulation.particles();
  const double k = scene.fluid.bulk_modulus, rho_0 = scene.fluid.density;
  double sum = simulation.totals().kinetic_energy;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double r = p.density[i] / rho_0;
    sum += p.mass[i] * (p.position[i].y() + k / rho_0 * ((std::pow(r, 6) - 1) / 6 + 1 / r - 1));
  }
  return sum;
}

}  // namespace

TEST_CASE("free surface: a tank at rest stays at rest") {
  const Scene scene = tank(8, 24, slips_freely, [](const Vec2& x) { return x.y() < 1; });
  const auto simulation = make_simulation(scene, cells_with(Scheme::Transfer::FlipBlend));
  for (int k = 0; k < 2000; ++k) simulation->advance(k * 2.5e-3, 2.5e-3);
  CHECK_FALSE(simulation->breakdown());
  // Equal rows balance weight and pressure but for O(h^2) of the density's curvature: measured 1.0e-6
  // sqrt(gH).
  CHECK(largest_speed(*simulation) < 3e-6);
}

TEST_CASE("free surface: a column that collapses gains no energy, in every transfer") {
  const auto transfer = GENERATE(Scheme::Transfer::Flip, Scheme::Transfer::FlipBlend, Scheme::Transfer::Apic);
  const Scene scene = tank(48, 24, slips_freely, [](const Vec2& x) { return x.x() < 0.5 && x.y() < 1; });
  const auto simulation = make_simulation(scene, cells_with(transfer));
  const double before = energy(*simulation, scene), dt = 1.5e-3;
  const long particles = static_cast<long>(simulation->particles().size());
  CHECK(particles == 8 * 16 * 4);
  for (int k = 0; k < 1000; ++k) simulation->advance(k * dt, dt);  // T = t sqrt(2 g/a) = 3
  CHECK_FALSE(simulation->breakdown());
  CHECK(energy(*simulation, scene) < 1.001 * before);
  double front = 0;
  for (const Vec2& x : simulation->particles().position) front = std::max(front, x.x());
  CHECK(front > 3.5 * 0.5);  // Martin & Moyce: 3.7 a
  CHECK(front < 4.3 * 0.5);
  for (const double density : simulation->particles().density) CHECK(density >= scene.fluid.density);
}

TEST_CASE("free surface: vector kernels give what the general solver gives") {
  for (const double slip_length : {0.0, 0.05, slips_freely})
    for (const auto stepping : {Scheme::Stepping::Usf, Scheme::Stepping::Usl, Scheme::Stepping::Musl}) {
      const Scene scene = tank(12, 12, slip_length, [](const Vec2& x) { return x.x() < 0.3 && x.y() < 0.5; });
      Scheme scheme = cells_with(Scheme::Transfer::Flip);
      scheme.stepping = stepping;
      const auto lanes = make_simulation(scene, scheme);
      const auto plain = make_general_solver(scene, scheme);
      for (int k = 0; k < 60; ++k) {
        lanes->advance(k * 1e-3, 1e-3);
        plain->advance(k * 1e-3, 1e-3);
      }
      double furthest = 0;
      for (std::size_t p = 0; p < plain->particles().size(); ++p)
        furthest =
            std::max(furthest, (lanes->particles().position[p] - plain->particles().position[p]).norm());
      INFO(slip_length << " " << name(stepping));
      CHECK(furthest < 1e-11);
      CHECK((lanes->totals().impulse - plain->totals().impulse).norm() <
            1e-9 * plain->totals().impulse.norm());
    }
}

TEST_CASE("partial slip: a Couette flow between plates of slip length b is steady with slope V/(H + 2b)") {
  Scene scene;
  scene.size = {1e-3 / 16, 1e-3};
  scene.cells = {1, 16};
  const double b = 0.25e-3, v = 1e-3;
  scene.side(Edge::Bottom) = Side::wall(Vec2::Zero(), b);
  scene.side(Edge::Top) = Side::wall(Vec2(v, 0), b);
  scene.fluid.rheology = Newtonian{1e-3};
  scene.fluid.pressure = false;
  const auto exact = [=](double y) { return v * (y + b) / (1e-3 + 2 * b); };
  scene.initial_velocity = [=](const Vec2& x) { return Vec2(exact(x.y()) + 0.1 * v, 0); };
  Scheme scheme;
  scheme.transfer = GENERATE(Scheme::Transfer::Flip, Scheme::Transfer::Apic);
  const auto simulation = make_simulation(scene, scheme);
  const double dt = 4e-4;  // nu dt/h^2 = 0.1
  for (int k = 0; k < 15000; ++k) simulation->advance(k * dt, dt);
  // The nodes are exact, as those of walls that hold the fluid; what FLIP's particles keep beside is the
  // smoothing of the field's kink at the wall.
  for (const Vec2& x : cell_corners(scene))
    CHECK(std::abs(simulation->grid_field({x}, 0).front().x() - exact(x.y())) < 1e-10 * v);
}

TEST_CASE("free surface: what it cannot go with is refused") {
  const Scene scene = tank(4, 4, 0, [](const Vec2& x) { return x.y() < 0.1; });
  CHECK_THROWS_WITH(make_simulation(scene, {}), contains("dilatation"));
  Scheme scheme = cells_with(Scheme::Transfer::Flip);
  scheme.stepping = Scheme::Stepping::Leapfrog;
  CHECK_THROWS_WITH(make_simulation(scene, scheme), contains("usf, usl or musl"));
  Scene dry = scene;
  dry.free_surface->is_fluid = [](const Vec2&) { return false; };
  CHECK_THROWS_WITH(make_simulation(dry, cells_with(Scheme::Transfer::Flip)), contains("no particle"));
  Scene slippery = scene;
  slippery.side(Edge::Left).slip_length = -1;
  CHECK_THROWS_WITH(make_simulation(slippery, cells_with(Scheme::Transfer::Flip)), contains("slip length"));
}
