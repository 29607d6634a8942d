// As kernel_count.cpp, of the schemes that are accurate in two dimensions.
#define MPM_ISA counted
#define MPM_LANES 1
#define MPM_COUNT_OPERATIONS
#include <cmath>
#include <numbers>

#include "solver/grid/sparse_pattern.hpp"
#include "solver/kernel/full_mass/lane_full_mass.hpp"
#include "solver/kernel/lane_kernel.hpp"
#include "solver/kernel/sweep.hpp"
#include "solver/lanes/full_mass_passes.hpp"
#include "solver/lanes/lane_particles.hpp"
#include "tests/bench/work_count.hpp"

namespace bench {
namespace {

constexpr int cells = 32, per_side = 2, steps_before = 20;
constexpr double density = 1000, sound = 20, bulk_modulus = density * sound * sound / 7, viscosity = 10;
constexpr double dt = 0.3 / cells / sound, no_force[2] = {0, 0};

/// The vortices of vortex_benchmark.cpp.
std::vector<mpm::PointState> vortices() {
  std::vector<mpm::PointState> points;
  constexpr double spacing = 1.0 / (cells * per_side), k = 2 * std::numbers::pi;
  for (int j = 0; j < cells * per_side; ++j)
    for (int i = 0; i < cells * per_side; ++i) {
      const double x = (i + 0.5) * spacing, y = (j + 0.5) * spacing;
      points.push_back(
          {.position = {x, y},
           .velocity = {std::sin(k * x) * std::cos(k * y), -std::cos(k * x) * std::sin(k * y)},
           .mass = density * spacing * spacing,
           .density = density,
           .stress = {},
           .affine = {{k * std::cos(k * x) * std::cos(k * y), -k * std::sin(k * x) * std::sin(k * y)},
                      {k * std::sin(k * x) * std::sin(k * y), -k * std::cos(k * x) * std::cos(k * y)}}});
    }
  return points;
}

mpm::KernelSetup setup_of(int degree, const mpm::LineOfCells& line,
                          const std::vector<mpm::PointState>& points) {
  return {.degree = degree,
          .strip = false,
          .axis = {line, line},
          .rheology = mpm::Newtonian{viscosity},
          .is_affine = true,
          .has_pressure = true,
          .has_cell_pressure = false,
          .pressure = {{bulk_modulus, 1 / density}, 0},
          .most_inverse_mass = std::numeric_limits<double>::infinity(),
          .points = points.data(),
          .count = points.size(),
          .shares = 1};
}

/// Of one step, when some have put the particles in disorder.
template <class Step>
double operations_of(const Step& step, std::size_t particles) {
  for (int k = 0; k < steps_before; ++k) step();
  mpm::counted::operations = 0;
  step();
  return static_cast<double>(mpm::counted::operations) / static_cast<double>(particles);
}

}  // namespace

double apic_operations_per_particle_step() {
  constexpr int degree = 2;
  const std::vector<mpm::PointState> points = vortices();
  const mpm::Axis axis(1, cells, true, degree);
  std::vector<double> functions;
  mpm::counted::LaneKernel<mpm::counted::LaneBasis<degree, false>> kernel(
      setup_of(degree, mpm::line_of_cells(axis, functions), points));
  const mpm::Part all = mpm::Sweep::whole({cells, cells + degree, degree, true});
  return operations_of(
      [&] {
        kernel.map_velocity(all);
        kernel.update_stress_and_accelerate(all, no_force, dt);
        kernel.take_and_move(all, 0, dt);
        kernel.settle();
      },
      points.size());
}

double full_mass_operations_per_particle_step() {
  constexpr int degree = 3;
  const std::vector<mpm::PointState> points = vortices();
  const mpm::Axis axis(1, cells, true, degree);
  std::vector<double> functions;
  const mpm::LineMass mass = mpm::line_mass(axis);
  mpm::counted::LaneFullMass<degree> kernel({setup_of(degree, mpm::line_of_cells(axis, functions), points),
                                             {mass, mass},
                                             {},
                                             mpm::negligible_mass});
  return operations_of(
      [&] {
        kernel.drift(dt / 2);
        kernel.project();
        kernel.accelerate(no_force);
        kernel.advance_from_start(dt / 2);
        kernel.accelerate(no_force);
        kernel.advance_from_start(dt);
        kernel.take();
        kernel.drift(dt / 2);
      },
      points.size());
}

}  // namespace bench
