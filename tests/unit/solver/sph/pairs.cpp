#include <map>
#include <random>

#include "solver/kernel/isa.hpp"
#include "solver/sph/make_sph_solver.hpp"
#include "solver/sph/pairs/pair_windows.hpp"
#include "tests/catch.hpp"

using namespace mpm;

TEST_CASE("windows of rows hold every pair within reach once, however entries lie", "[sph]") {
  constexpr double height = 0.1, reach = 0.37;
  constexpr std::size_t fluid = 150, wall_begin = 220, count = 300;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> inside(0, 1), around(-0.4, 1.4);
  VectorField position;
  for (std::size_t e = 0; e < count; ++e) {
    auto& place = e < fluid ? inside : around;
    position.emplace_back(place(random), place(random));
  }
  sph::EntryRows rows;
  rows.rebuild(position, wall_begin, height);
  for (const int lanes : {2, 4, 8}) {
    sph::PairWindows windows;
    windows.rebuild(rows, position, fluid, reach, lanes);
    std::map<std::uint32_t, std::uint32_t> entry_in;  // slots that are not empty
    for (std::uint32_t e = 0; e < count; ++e) entry_in[rows.slots()[e]] = e;
    std::size_t particles = 0, pairs = 0;
    for (std::size_t g = 0; g < windows.groups().size(); ++g) {
      const sph::Group& group = windows.groups()[g];
      for (std::uint32_t lane = 0; lane < group.count; ++lane, ++particles) {
        const std::uint32_t p = entry_in.at(group.slot + lane);
        REQUIRE(p < fluid);
        CHECK(windows.place(p) == g * static_cast<std::size_t>(lanes) + lane);
        std::vector<int> met(count, 0);
        for (std::uint32_t w = group.begin; w < group.end; ++w)
          for (std::uint32_t k = 0; k < windows.windows()[w].count; ++k) {
            const std::uint32_t slot = windows.windows()[w].first + lane + k;
            REQUIRE(slot < rows.slot_count());
            if (!entry_in.contains(slot)) continue;
            ++met[entry_in[slot]];
            CHECK((entry_in[slot] < wall_begin) == (w < group.walls));
          }
        for (std::uint32_t e = 0; e < count; ++e) {
          CHECK(met[e] <= 1);
          if ((position[e] - position[p]).norm() < reach) CHECK(met[e] == 1);
        }
      }
      for (std::uint32_t w = group.begin; w < group.end; ++w)
        pairs += windows.windows()[w].count * static_cast<std::size_t>(lanes);
    }
    CHECK(particles == fluid);
    CHECK(pairs == windows.pairs());
  }
}

TEST_CASE("SPH comes to the same on every instruction set", "[sph]") {
  for (const SphScheme::Wall wall : {SphScheme::Wall::Mirror, SphScheme::Wall::Morris}) {
    Scene scene;
    scene.size = {13e-4, 1e-3};
    scene.cells = {13, 10};
    scene.particles_per_cell = {1, 1};
    scene.seeding.displacement = 0.3;
    scene.side(Edge::Bottom) = Side::wall(Vec2::Zero());
    scene.side(Edge::Top) = Side::wall(Vec2(1e-3, 0));
    scene.fluid.rheology = Cross<SquareRoot>{1e-3, 5e-4, 1.0, {}};
    scene.fluid.bulk_modulus = 1000 * 0.05 * 0.05 / 7;
    scene.body_acceleration = [](double) { return Vec2(8e-3, -1e-2); };
    SphScheme scheme;
    scheme.wall = wall;
    const std::string before = current_isa();
    std::vector<Particles> ends;
    for (const std::string& isa : available_isas()) {
      use_isa(isa);
      const auto simulation = make_sph_solver(scene, scheme, 1);
      for (int k = 0; k < 40; ++k) simulation->advance(k * 1e-4, 1e-4);
      REQUIRE(!simulation->breakdown());
      ends.push_back(simulation->particles());
    }
    use_isa(before);
    for (const Particles& end : ends)
      for (std::size_t p = 0; p < end.size(); ++p) {
        // Velocities of 6e-4 m/s were 1.1e-19 apart at most, densities of 1000 kg/m3 not at all: a hundred
        // roundings.
        CHECK((end.velocity[p] - ends[0].velocity[p]).norm() < 1e-17);
        CHECK(std::abs(end.density[p] - ends[0].density[p]) < 2e-11);
      }
  }
}
