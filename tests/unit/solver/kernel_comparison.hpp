#pragma once

#include <cmath>
#include <numbers>

#include "solver/kernel/isa.hpp"
#include "solver/simulation.hpp"
#include "solver/table/make_solver.hpp"
#include "tests/catch.hpp"

// What the vector kernels are held against: the general solver on the same scenes.
namespace kernel_comparison {

using namespace mpm;

constexpr double cell = 1e-4;  // [m]

inline Scene box(int nx, int ny) {
  Scene scene;
  scene.size = {cell * nx, cell * ny};
  scene.cells = {nx, ny};
  scene.fluid.rheology = Newtonian{1e-3};
  return scene;
}

/// A flow in which all components of velocity and stress matter, fast enough to cross a tenth of a cell a
/// step.
inline Scene whirl(int nx, int ny) {
  Scene scene = box(nx, ny);
  const Vec2 k = 2 * std::numbers::pi * scene.size.cwiseInverse();
  scene.initial_velocity = [=](const Vec2& x) {
    return Vec2(0.1 + 0.05 * std::sin(k.y() * x.y()), -0.07 + 0.04 * std::cos(k.x() * x.x()));
  };
  scene.body_acceleration = [](double t) { return Vec2(3 + 100 * t, -2); };
  return scene;
}

inline void run_steps(Simulation& simulation, double dt, int steps) {
  for (int k = 0; k < steps; ++k) {
    simulation.advance(k * dt, dt);
    REQUIRE_FALSE(simulation.breakdown());
  }
}

/// Largest difference between two fields, relative to the largest value.
inline double difference(const VectorField& a, const VectorField& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0, apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, a[i].norm());
    apart = std::max(apart, (a[i] - b[i]).norm());
  }
  return apart / largest;
}

// Round-off of a few dozen steps; a sum taken in another order moves the last digits of numbers of size one,
// and the stress of a nearly incompressible fluid (sound 10 to 100 times faster than the flow) magnifies
// that.
constexpr double round_off = 1e-11;

inline void require_same(const Simulation& a, const Simulation& b, double t, bool compare_stress) {
  CHECK(difference(a.particles().velocity, b.particles().velocity) < round_off);
  CHECK(difference(a.particles().position, b.particles().position) < round_off);
  double density = 0, stress = 0, largest = 0;
  for (std::size_t p = 0; p < a.particles().size(); ++p) {
    density = std::max(density, std::abs(a.particles().density[p] / b.particles().density[p] - 1));
    stress = std::max(stress, (a.particles().stress[p] - b.particles().stress[p]).norm());
    largest = std::max(largest, a.particles().stress[p].norm());
  }
  CHECK(density < round_off);
  if (compare_stress)
    CHECK(stress <= 1e-9 * (largest + 143));  // pressure is 143 Pa times 7 times the change of density
  const VectorField points{{0.3 * cell, 0.2 * cell}, {1.7 * cell, 2.4 * cell}, {2.5 * cell, 3.1 * cell}};
  CHECK(difference(a.grid_field(points, t), b.grid_field(points, t)) < round_off);
  const Totals sum_a = a.totals(), sum_b = b.totals();
  CHECK((sum_a.impulse - sum_b.impulse).norm() <
        round_off * (sum_b.impulse.norm() + sum_b.mass * 0.1));  // 0.1 m/s: the flow's
}

inline void require_same_as_plain(const Scene& scene, const Scheme& scheme, double dt = 1e-5,
                                  int steps = 40) {
  for (const std::string& isa : available_isas()) {
    INFO(name(scheme.basis) << " " << name(scheme.transfer) << " " << name(scheme.stepping) << " " << isa);
    use_isa(isa);
    const auto vectors = make_simulation(scene, scheme);
    const auto plain = make_general_solver(scene, scheme);
    run_steps(*vectors, dt, steps);
    run_steps(*plain, dt, steps);
    // In USF the general solver keeps the stress that the last step began with, the kernels none.
    require_same(*vectors, *plain, steps * dt, scheme.stepping != Scheme::Stepping::Usf);
  }
  use_isa(available_isas().back());
}

inline const std::vector<Scheme::Basis> bases{Scheme::Basis::Linear, Scheme::Basis::Quadratic,
                                              Scheme::Basis::Cubic};

}  // namespace kernel_comparison
