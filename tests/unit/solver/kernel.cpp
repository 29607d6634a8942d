#include <cmath>
#include <limits>
#include <numbers>

#include "solver/kernel/isa.hpp"
#include "solver/simulation.hpp"
#include "solver/step/time_step.hpp"
#include "tests/catch.hpp"
#include "tests/unit/solver/kernel_comparison.hpp"

using namespace mpm;
using namespace kernel_comparison;

TEST_CASE("vector kernels give what the general solver gives: every scheme that they cover") {
  for (const Scheme::Basis basis : bases)
    for (const Scheme::Transfer transfer :
         {Scheme::Transfer::Flip, Scheme::Transfer::Pic, Scheme::Transfer::FlipBlend, Scheme::Transfer::Apic})
      for (const Scheme::Stepping stepping :
           {Scheme::Stepping::Usf, Scheme::Stepping::Usl, Scheme::Stepping::Musl}) {
        Scene scene = whirl(5, 7);
        scene.side(Edge::Bottom) = Side::wall(Vec2(0.02, 0));
        scene.side(Edge::Top) = Side::wall(Vec2(-0.01, 0));
        scene.initial_velocity = [](const Vec2& x) { return Vec2(0.1 * std::sin(1e4 * x.y()), 0); };
        require_same_as_plain(scene, {basis, transfer, stepping});
      }
}

TEST_CASE("vector kernels: every rheology, with pressure and without") {
  const std::vector<Rheology> fluids{Newtonian{1e-3},
                                     Cross<SquareRoot>{1e-3, 4e-3, 1e-2, {}},
                                     Cross<RealPower>{1e-3, 2e-4, 1e-2, {0.35}},
                                     PowerLaw{1e-3, 0.8, 1e-3, 0},
                                     CarreauYasuda{1e-3, 1e-4, 1e-2, 1.5, 0.6, 0},
                                     HerschelBulkley{1e-3, 0.8, 1e-2, 0.02, 1e-3, 0}};
  for (const Rheology& fluid : fluids)
    for (const bool pressure : {true, false})
      for (const Scheme::Basis basis : bases) {
        Scene scene = whirl(4, 6);
        scene.fluid.rheology = fluid;
        scene.fluid.pressure = pressure;
        require_same_as_plain(scene, {basis});
      }
}

TEST_CASE("vector kernels: walls on all sides, on any two, on none; wide, tall and one cell across") {
  for (const Scheme::Basis basis : bases)
    for (const auto& size : {std::pair{6, 5}, {1, 9}, {9, 1}, {2, 3}, {17, 20}, {23, 3}})
      for (int walls = 0; walls < 4; ++walls) {
        const int nx = size.first, ny = size.second;
        INFO(nx << " x " << ny << ", walls " << walls);
        Scene scene = whirl(nx, ny);
        // At walls a flow through them would leave; along a single cell nothing may vary.
        if (walls || nx == 1 || ny == 1)
          scene.initial_velocity = [=](const Vec2& x) {
            return ny == 1 ? Vec2(0, 0.1 * std::sin(1e3 * x.x())) : Vec2(0.1 * std::sin(1e3 * x.y()), 0);
          };
        if (walls & 1) {
          scene.side(Edge::Left) = Side::wall(Vec2(0, 0.02));
          scene.side(Edge::Right) = Side::wall(Vec2(0, -0.03));
        }
        if (walls & 2) {
          scene.side(Edge::Bottom) = Side::wall(Vec2(0.02, 0));
          scene.side(Edge::Top) = Side::wall(Vec2(-0.01, 0));
        }
        require_same_as_plain(scene, {basis}, 1e-6, 20);
      }
}

TEST_CASE("vector kernels: particles displaced, unequal in number, and many cells a step") {
  for (const Scheme::Basis basis : bases) {
    Scene scene = whirl(6, 5);
    scene.particles_per_cell = {3, 2};
    scene.seeding.displacement = 0.5;
    require_same_as_plain(scene, {basis, Scheme::Transfer::FlipBlend});
    // Rigid translation of up to three cells a step: no stress, so that so long a step is exact.
    scene.initial_velocity = [](const Vec2&) { return Vec2(31.3, -17.7); };
    scene.body_acceleration = nullptr;
    scene.fluid.pressure = false;
    require_same_as_plain(scene, {basis, Scheme::Transfer::Pic});
  }
}

namespace {

/// Large enough to be swept in two segments, 30 cells along the lanes.
Scene long_whirl(bool walls_along, bool walls_across) {
  Scene scene = whirl(30, 560);
  scene.particles_per_cell = {1, 1};
  scene.seeding.displacement = 0.4;
  if (walls_along) {
    scene.side(Edge::Left) = Side::wall(Vec2(0, 0.02));
    scene.side(Edge::Right) = Side::wall(Vec2(0, -0.03));
  }
  if (walls_across) {
    scene.side(Edge::Bottom) = Side::wall(Vec2(0.02, 0));
    scene.side(Edge::Top) = Side::wall(Vec2(-0.01, 0));
  }
  if (walls_along || walls_across)
    scene.initial_velocity = [=](const Vec2& x) {
      return walls_along ? Vec2(0, 0.1 * std::sin(1e3 * x.x())) : Vec2(0.1 * std::sin(1e3 * x.y()), 0);
    };
  return scene;
}

}  // namespace

TEST_CASE("vector kernels: a grid that is swept, cut and closed") {
  for (const Scheme::Basis basis : bases)
    for (const Scheme::Stepping stepping :
         {Scheme::Stepping::Usf, Scheme::Stepping::Usl, Scheme::Stepping::Musl})
      require_same_as_plain(long_whirl(false, false), {basis, Scheme::Transfer::FlipBlend, stepping}, 1e-5,
                            8);
  for (const auto& [along, across] : {std::pair{false, true}, {true, false}, {true, true}})
    require_same_as_plain(long_whirl(along, across), {Scheme::Basis::Quadratic, Scheme::Transfer::FlipBlend},
                          1e-6, 8);
}

TEST_CASE("vector kernels: the number of threads changes no bit") {
  for (const Scheme::Basis basis : bases)
    for (const bool walls : {false, true}) {
      const Scene scene = long_whirl(walls, false);
      const auto one = make_simulation(scene, {basis}, 1), three = make_simulation(scene, {basis}, 3);
      run_steps(*one, 1e-5, 10);
      run_steps(*three, 1e-5, 10);
      CHECK(one->particles().position == three->particles().position);
      CHECK(one->particles().velocity == three->particles().velocity);
      CHECK(one->particles().density == three->particles().density);
      CHECK(one->totals().impulse == three->totals().impulse);
    }
}

TEST_CASE("a part of a sweep without cells touches no node: it may be another thread's") {
  // 1 - s and s, and where their control points are, in both cells, as Axis gives them.
  const double functions[] = {1, 0, -1, 1, 0, 1, 1, 0, -1, 1, 0, 1};
  const PointState point{{0.5, 0.5}, {1, 1}, 1, 1, {1, 1, 1}, {}};
  const LineOfCells axis{2, false, 2, 1, functions};
  const auto kernel = make_kernel({.degree = 1,
                                   .strip = false,
                                   .axis = {axis, axis},
                                   .rheology = Newtonian{1},
                                   .is_affine = false,
                                   .keeps_stress = false,
                                   .has_pressure = true,
                                   .has_cell_pressure = false,
                                   .pressure = {{1, 1}, 0},
                                   .most_inverse_mass = std::numeric_limits<double>::infinity(),
                                   .points = &point,
                                   .count = 1,
                                   .shares = 1});
  const NodeFields nodes = kernel->nodes();
  // Adding nothing to it would turn it into +0.
  double* const fields[] = {nodes.inverse_mass, nodes.velocity[0], nodes.mapped[0], nodes.acceleration[0]};
  for (double* field : fields) field[0] = -0.0;
  const double none[] = {0, 0};
  kernel->map_velocity({});
  kernel->map_updated_velocity({});
  kernel->accelerate({}, none, 1);
  kernel->update_stress_and_accelerate({}, none, 1);
  for (const double* field : fields) CHECK(std::signbit(field[0]));
}

TEST_CASE("a simulation outlives the scene that it was made from") {
  for (const auto transfer :
       {Scheme::Transfer::Flip, Scheme::Transfer::FullMass}) {  // vector kernels; general
    const Scheme scheme{Scheme::Basis::Linear, transfer, Scheme::Stepping::Usf};
    const Scene scene = whirl(6, 5);
    const auto beside = make_simulation(scene, scheme);
    auto passing = std::make_unique<Scene>(scene);
    const auto alone = make_simulation(*passing, scheme);
    *passing = Scene();
    passing.reset();
    for (Simulation* simulation : {beside.get(), alone.get()}) run_steps(*simulation, 1e-6, 20);
    CHECK(difference(alone->particles().velocity, beside->particles().velocity) == 0);
  }
}

TEST_CASE("a breakdown is found by the vector kernels, too") {
  Scene scene = box(4, 9);
  scene.side(Edge::Bottom) = scene.side(Edge::Top) = Side::wall(Vec2::Zero());
  const auto breakdown = [&](const Vec2& left, const Vec2& right, double dt) {
    Scheme scheme;
    scheme.stepping = Scheme::Stepping::Usl;  // no force yet from what is found at the end of the step
    scene.initial_velocity = [=](const Vec2& x) { return x.x() < 2 * cell ? left : right; };
    const auto simulation = make_simulation(scene, scheme);
    simulation->advance(0, dt);
    return simulation->breakdown().value_or("none");
  };
  CHECK(breakdown({1e-3, 0}, {0, 0}, 1e-6) == "none");
  CHECK(breakdown({NAN, 0}, {0, 0}, 1e-6) == "velocity is not finite");
  CHECK(breakdown({0, 10}, {0, 10}, 4e-5) == "a particle left the domain");
  CHECK(breakdown({10, 0}, {-10, 0}, 4e-5) == "density is not positive");  // two cells' fluid meets in one
  // Around a periodic side so often that nobody knows any more where it ends.
  CHECK(breakdown({1e25, 0}, {1e25, 0}, 4e-5) == "a particle left the domain");
}

TEST_CASE("an instruction set can be chosen by name, and is refused by what it lacks") {
  CHECK(available_isas().front() == "baseline");
  use_isa("baseline");
  CHECK(current_isa() == "baseline");
  CHECK_THROWS_WITH(use_isa("abacus"), contains("baseline"));
  use_isa(available_isas().back());
}
