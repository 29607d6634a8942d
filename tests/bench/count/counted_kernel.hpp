#pragma once

// The vector kernels compiled with one lane and with operations that count themselves. Included by the
// translation units that count alone.
#define MPM_ISA counted
#define MPM_LANES 1
#define MPM_COUNT_OPERATIONS
#include <limits>
#include <vector>

#include "solver/grid/axis.hpp"
#include "solver/kernel/lane_kernel.hpp"
#include "solver/kernel/threads/sweep.hpp"
#include "solver/lanes/lane_particles.hpp"

namespace bench {

/// A Newtonian fluid with pressure on square cells, 2 x 2 particles a cell at rest.
struct CountedScene {
  int cells[2];
  bool periodic[2];
  double h, density, bulk_modulus, viscosity;
  int degree;
  bool is_affine;

  [[nodiscard]] mpm::Axis axis(int a) const { return {h * cells[a], cells[a], periodic[a], degree}; }
};

inline std::vector<mpm::PointState> points_of(const CountedScene& scene) {
  constexpr int per_side = 2;
  std::vector<mpm::PointState> points;
  const double spacing = scene.h / per_side;
  for (int j = 0; j < scene.cells[1] * per_side; ++j)
    for (int i = 0; i < scene.cells[0] * per_side; ++i)
      points.push_back({.position = {(i + 0.5) * spacing, (j + 0.5) * spacing},
                        .velocity = {0, 0},
                        .mass = scene.density * spacing * spacing,
                        .density = scene.density,
                        .stress = {},
                        .affine = {}});
  return points;
}

/// `functions` and `points` hold what the setup points to.
inline mpm::KernelSetup setup_of(const CountedScene& scene, std::vector<double> (&functions)[2],
                                 const std::vector<mpm::PointState>& points) {
  return {.degree = scene.degree,
          .strip = false,
          .axis = {mpm::line_of_cells(scene.axis(0), functions[0]),
                   mpm::line_of_cells(scene.axis(1), functions[1])},
          .rheology = mpm::Newtonian{scene.viscosity},
          .is_affine = scene.is_affine,
          .keeps_stress = false,
          .has_pressure = true,
          .has_cell_pressure = false,
          .pressure = {{scene.bulk_modulus, 1 / scene.density}, 0},
          .most_inverse_mass = std::numeric_limits<double>::infinity(),
          .points = points.data(),
          .count = points.size(),
          .shares = 1};
}

/// Of one step, when some have put the particles in disorder.
template <class Step>
double operations_of(const Step& step, std::size_t particles, int steps_before) {
  for (int k = 0; k < steps_before; ++k) step();
  mpm::counted::operations = 0;
  step();
  return static_cast<double>(mpm::counted::operations) / static_cast<double>(particles);
}

}  // namespace bench
