#include "reference/channel/discrete_usf_channel.hpp"

#include <algorithm>
#include <cmath>

#include "reference/channel/newtonian_channel.hpp"
#include "tests/catch.hpp"

using namespace reference;

namespace {

constexpr double kHeight = 1e-3, kNu = 1e-6;

DiscreteUsfChannelParameters scene(int cells, int per_cell, double force, double plate, double r) {
  const double h = kHeight / cells;
  return {kHeight, cells, per_cell, kNu, force, plate, r * h * h / kNu};
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

// A one-dimensional material point method in so many words: lumped linear P2G, USF stress, FLIP.
struct Mpm {
  explicit Mpm(const DiscreteUsfChannelParameters& s) : scene(s) {
    for (int row = 0; row < s.cells * s.particles_per_cell; ++row) {
      y.push_back((row + 0.5) * s.height / (s.cells * s.particles_per_cell));
      const auto [c, xi] = where(row);
      v.push_back(c == s.cells - 1 ? xi * s.plate_velocity : 0.0);  // the wall node's share
    }
  }

  std::pair<int, double> where(int row) const {
    const double s = y[row] / scene.height * scene.cells;
    return {static_cast<int>(s), s - std::floor(s)};
  }

  std::vector<double> nodes() const {
    std::vector<double> mass(scene.cells + 1, 0.0), momentum(scene.cells + 1, 0.0);
    for (std::size_t p = 0; p < y.size(); ++p) {
      const auto [c, xi] = where(static_cast<int>(p));
      mass[c] += 1 - xi, mass[c + 1] += xi;
      momentum[c] += (1 - xi) * v[p], momentum[c + 1] += xi * v[p];
    }
    for (std::size_t i = 0; i < mass.size(); ++i) momentum[i] /= mass[i];
    momentum.front() = 0.0, momentum.back() = scene.plate_velocity;
    return momentum;
  }

  void step() {
    const double h = scene.height / scene.cells, volume = h / scene.particles_per_cell;  // unit density
    const std::vector<double> u = nodes();
    std::vector<double> mass(u.size(), 0.0), force(u.size(), 0.0);
    for (std::size_t p = 0; p < y.size(); ++p) {
      const auto [c, xi] = where(static_cast<int>(p));
      const double tau = scene.kinematic_viscosity * (u[c + 1] - u[c]) / h;
      mass[c] += (1 - xi) * volume, mass[c + 1] += xi * volume;
      force[c] += volume * tau / h + (1 - xi) * volume * scene.body_acceleration;
      force[c + 1] += -volume * tau / h + xi * volume * scene.body_acceleration;
    }
    for (std::size_t i = 0; i < u.size(); ++i) force[i] /= mass[i];
    force.front() = force.back() = 0.0;  // steady walls: prescribed acceleration zero
    for (std::size_t p = 0; p < y.size(); ++p) {
      const auto [c, xi] = where(static_cast<int>(p));
      v[p] += scene.time_step * ((1 - xi) * force[c] + xi * force[c + 1]);
    }
  }

  DiscreteUsfChannelParameters scene;
  std::vector<double> y, v;
};

}  // namespace

TEST_CASE("discrete USF channel: equals its own recurrence stepped") {
  const auto per_cell = GENERATE(1, 2, 3, 4);
  const DiscreteUsfChannelParameters s = scene(20, per_cell, 8e-3, -3e-4, 0.4);
  const DiscreteUsfChannel exact(s);
  const double q = exact.neighbour_weight(), h = s.height / s.cells, scale = 1e-3;
  std::vector<double> v(s.cells + 1, 0.0), a(s.cells + 1, 0.0);
  v.back() = s.plate_velocity;
  v[s.cells - 1] = q * s.plate_velocity;
  for (int step = 0; step <= 1000; ++step) {
    // Each of the n additions rounds at 1e-16 of the scale; 1000 of them, damped, stay below 1e-13.
    if (step % 50 == 0 || step < 5) CHECK(largest_difference(v, exact.node_velocity(step)) < 1e-13 * scale);
    for (int i = 1; i < s.cells; ++i) {
      a[i] = s.body_acceleration + s.kinematic_viscosity / (h * h) * (v[i - 1] - 2 * v[i] + v[i + 1]);
    }
    for (int i = 1; i < s.cells; ++i)
      v[i] += s.time_step * (q * a[i - 1] + (1 - 2 * q) * a[i] + q * a[i + 1]);
  }
}

TEST_CASE("discrete USF channel: equals a material point method, nodes and particles") {
  const auto per_cell = GENERATE(1, 2, 3);
  const auto drive = GENERATE(std::pair{8e-3, 0.0}, std::pair{0.0, 1e-3}, std::pair{-8e-3, 5e-4});
  const DiscreteUsfChannelParameters s = scene(10, per_cell, drive.first, drive.second, 0.5);
  const DiscreteUsfChannel exact(s);
  Mpm mpm(s);
  CHECK(largest_difference(mpm.y, exact.particle_height()) < 1e-15 * kHeight);
  for (int step = 0; step <= 400; ++step) {
    // Round-off as above; one particle a cell has the weakest mode's S = cos^2(0.45 pi) = 0.024, which
    // magnifies it 41 times.
    const double tolerance = (per_cell == 1 ? 4e-12 : 1e-13) * 1e-3;
    if (step % 40 == 0 || step < 3) {
      CHECK(largest_difference(mpm.nodes(), exact.node_velocity(step)) < 1e-13 * 1e-3);
      CHECK(largest_difference(mpm.v, exact.particle_velocity(step)) < tolerance);
    }
    mpm.step();
  }
}

TEST_CASE("discrete USF channel: steady nodes are exact, steady particles carry the bias (3/32) h^2 F/nu") {
  const DiscreteUsfChannelParameters s = scene(40, 2, 8e-3, 1e-4, 0.5);
  const DiscreteUsfChannel exact(s);
  CHECK(exact.neighbour_weight() == Approx(3.0 / 16.0).epsilon(1e-15));
  const NewtonianChannel flow({kHeight, kNu, s.body_acceleration, s.plate_velocity});
  const long late = 200000;  // nu t/H^2 = 62: nothing is left of any mode
  const std::vector<double> nodes = exact.node_velocity(late), particles = exact.particle_velocity(late);
  for (int j = 0; j <= s.cells; ++j) {
    CHECK(std::abs(nodes[j] - flow.velocity(std::min(kHeight, kHeight * j / s.cells), 1e9)) < 1e-14 * 1e-3);
  }
  const double h = kHeight / s.cells, bias = 3.0 / 32.0 * h * h * s.body_acceleration / kNu;
  const std::vector<double> y = exact.particle_height();
  // The walls disturb the bias by a layer that falls by 3 a cell: 3^-16 = 2e-8 of it remains at the 16th
  // cell.
  for (std::size_t p = 32; p < y.size() - 32; ++p) {
    CHECK(particles[p] - flow.velocity(y[p], 1e9) == Approx(bias).epsilon(1e-6));
  }
}

TEST_CASE("discrete USF channel: converges to the exact flow with order two, and to the stability limit") {
  const auto error = [](int cells) {
    const DiscreteUsfChannelParameters s = scene(cells, 2, 8e-3, 0.0, 0.1);
    const long steps = 10l * cells * cells / 20;  // nu t/H^2 = 0.05
    const std::vector<double> v = DiscreteUsfChannel(s).node_velocity(steps);
    const NewtonianChannel flow({kHeight, kNu, 8e-3, 0.0});
    return std::abs(v[cells / 2] - flow.velocity(0.5 * kHeight, steps * s.time_step));
  };
  // dt ~ h^2, so one order two; the next term of the expansion is (pi/20)^2 of the first, hence the band.
  CHECK(std::log2(error(40) / error(80)) == Approx(2.0).margin(0.05));

  // r = nu dt/h^2 <= 3/2 (p = 2): the fastest mode has dt S lambda = r max 4 s (1 - 3 s/4) = 4 r/3.
  const auto peak = [](double r) {
    const std::vector<double> v = DiscreteUsfChannel(scene(64, 2, 8e-3, 0.0, r)).node_velocity(20000);
    return std::abs(*std::max_element(v.begin(), v.end()));
  };
  CHECK(peak(1.499) < 1.01e-3);
  CHECK(peak(1.51) > 1.0);
}

TEST_CASE("discrete USF channel: bad arguments are refused") {
  CHECK_THROWS_WITH(DiscreteUsfChannel({kHeight, 1, 2, kNu, 0, 0, 1e-6}), contains("two cells"));
  CHECK_THROWS_WITH(DiscreteUsfChannel({kHeight, 10, 0, kNu, 0, 0, 1e-6}), contains("particle"));
  CHECK_THROWS_WITH(DiscreteUsfChannel({kHeight, 10, 2, kNu, 0, 0, 0.0}), contains("time step"));
  CHECK_THROWS_WITH(DiscreteUsfChannel({0.0, 10, 2, kNu, 0, 0, 1e-6}), contains("height"));
  CHECK_THROWS_WITH(DiscreteUsfChannel({kHeight, 10, 2, 0.0, 0, 0, 1e-6}), contains("viscosity"));
  CHECK_THROWS_WITH(DiscreteUsfChannel({kHeight, 10, 2, kNu, 0, 0, 1e-6}).node_velocity(-1),
                    contains("step"));
}
