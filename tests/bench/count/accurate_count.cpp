// As kernel_count.cpp, of the schemes that are accurate in two dimensions.
#include "tests/bench/count/counted_kernel.hpp"
// After it: kernels that count themselves.
#include "solver/grid/matrices/sparse_pattern.hpp"
#include "solver/kernel/full_mass/lane_full_mass.hpp"
#include "solver/lanes/line_mass.hpp"
#include "tests/bench/count/work_count.hpp"
#include "tests/bench/vortices.hpp"

namespace bench {
namespace {

constexpr int cells = 32, steps_before = 20;
constexpr double no_force[2] = {0, 0};

CountedScene scene_of(int degree) {
  return {{cells, cells},
          {true, true},
          vortex_box.length / cells,
          vortex_box.density,
          vortex_box.bulk_modulus,
          vortex_box.viscosity,
          degree,
          true};
}

std::vector<mpm::PointState> whirling(const CountedScene& scene) {
  std::vector<mpm::PointState> points = points_of(scene);
  const mpm::Scene vortex = vortices(cells);
  constexpr double k = 2 * std::numbers::pi;
  for (mpm::PointState& p : points) {
    const auto [x, y] = p.position;
    const mpm::Vec2 v = vortex.initial_velocity({x, y});
    const double normal = k * std::cos(k * x) * std::cos(k * y),
                 shear = k * std::sin(k * x) * std::sin(k * y);
    p.velocity[0] = v.x();
    p.velocity[1] = v.y();
    p.affine[0][0] = normal;
    p.affine[0][1] = -shear;
    p.affine[1][0] = shear;
    p.affine[1][1] = -normal;
  }
  return points;
}

}  // namespace

double apic_operations_per_particle_step() {
  constexpr int degree = 2;
  const CountedScene scene = scene_of(degree);
  const std::vector<mpm::PointState> points = whirling(scene);
  std::vector<double> functions[2];
  mpm::counted::LaneKernel<mpm::counted::LaneBasis<degree, false>> kernel(setup_of(scene, functions, points));
  const mpm::Part all = mpm::Sweep::whole({cells, cells + degree, degree, true});
  const double dt = sonic_step(cells);
  return operations_of(
      [&] {
        kernel.map_velocity(all);
        kernel.update_stress_and_accelerate(all, no_force, dt);
        kernel.take_and_move(all, 0, dt);
        kernel.settle();
      },
      points.size(), steps_before);
}

FullMassCount full_mass_count() {
  constexpr int degree = 3;
  const CountedScene scene = scene_of(degree);
  const std::vector<mpm::PointState> points = whirling(scene);
  std::vector<double> functions[2];
  const mpm::LineMass mass = mpm::line_mass(scene.axis(0), false);
  mpm::ThreadTeam alone(1);
  mpm::counted::LaneFullMass<degree> kernel({setup_of(scene, functions, points),
                                             {mass, mass},
                                             {mass, mass},
                                             {},
                                             false,
                                             mpm::negligible_mass,
                                             &alone});
  const double dt = sonic_step(cells);
  long iterations_before = 0;
  const double operations = operations_of(
      [&] {
        iterations_before = kernel.iterations();
        kernel.drift(dt / 2);
        kernel.project();
        kernel.kick(mpm::Kick::ToMiddle, no_force, dt / 2);
        kernel.kick(mpm::Kick::Whole, no_force, dt);
        kernel.take();
        kernel.drift(dt / 2);
      },
      points.size(), steps_before);
  return {operations, static_cast<double>(kernel.iterations() - iterations_before) / 3};
}

}  // namespace bench
