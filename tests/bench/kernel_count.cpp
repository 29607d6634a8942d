// The vector kernel compiled with one lane and with operations that count themselves.
#define MPM_ISA counted
#define MPM_LANES 1
#define MPM_COUNT_OPERATIONS
#include "solver/grid/axis.hpp"
#include "solver/kernel/lane_kernel.hpp"
#include "solver/kernel/sweep.hpp"
#include "tests/bench/work_count.hpp"

namespace bench {
namespace {

constexpr int cells[2] = {20, 10}, per_side = 2;  // along the lanes from wall to wall, periodic across them
constexpr double h = 0.5e-4, density = 1000, bulk_modulus = 143, viscosity = 1e-3, dt = 5e-6;

std::vector<mpm::PointState> lattice() {
  std::vector<mpm::PointState> points;
  constexpr double spacing = h / per_side;
  for (int j = 0; j < cells[1] * per_side; ++j)
    for (int i = 0; i < cells[0] * per_side; ++i)
      points.push_back({.position = {(i + 0.5) * spacing, (j + 0.5) * spacing},
                        .velocity = {0, 0},
                        .mass = density * spacing * spacing,
                        .density = density,
                        .stress = {0, 0, 0},
                        .affine = {}});
  return points;
}

}  // namespace

double kernel_operations_per_particle_step() {
  const std::vector<mpm::PointState> points = lattice();
  const mpm::Axis axis[2] = {{h * cells[0], cells[0], false, 1}, {h * cells[1], cells[1], true, 1}};
  std::vector<double> functions[2];
  const auto line = [&](int a) {
    for (int cell = 0; cell < cells[a]; ++cell) {
      functions[a].insert(functions[a].end(), axis[a].polynomials(cell), axis[a].polynomials(cell) + 4);
      for (int k : {0, 1}) functions[a].push_back(axis[a].control_place(cell, k));
    }
    return mpm::LineOfCells{cells[a], axis[a].periodic, axis[a].length, axis[a].inverse_h,
                            functions[a].data()};
  };
  mpm::counted::LaneKernel<mpm::counted::LaneBasis<1, false>> kernel(
      {.degree = 1,
       .strip = false,
       .axis = {line(0), line(1)},
       .rheology = mpm::Newtonian{viscosity},
       .is_affine = false,
       .has_pressure = true,
       .has_cell_pressure = false,
       .pressure = {{bulk_modulus, 1 / density}, 0},
       .most_inverse_mass = std::numeric_limits<double>::infinity(),
       .points = points.data(),
       .count = points.size(),
       .shares = 1});
  const mpm::Part all = mpm::Sweep::whole({cells[1], cells[0] + 1, 1, true});
  const double body_acceleration[2] = {0, 8e-3};
  mpm::counted::operations = 0;
  kernel.map_velocity(all);
  kernel.update_stress_and_accelerate(all, body_acceleration, dt);
  kernel.take_and_move(all, 1, dt);
  return static_cast<double>(mpm::counted::operations) / static_cast<double>(points.size());
}

}  // namespace bench
