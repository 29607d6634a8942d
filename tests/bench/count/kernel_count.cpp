#include "tests/bench/count/counted_kernel.hpp"
#include "tests/bench/count/work_count.hpp"

namespace bench {

double kernel_operations_per_particle_step() {
  // Along the lanes from wall to wall, periodic across them.
  const CountedScene scene{{20, 10}, {false, true}, 0.5e-4, 1000, 143, 1e-3, 1, false};
  const std::vector<mpm::PointState> points = points_of(scene);
  std::vector<double> functions[2];
  mpm::counted::LaneKernel<mpm::counted::LaneBasis<1, false>> kernel(setup_of(scene, functions, points));
  const mpm::Part all = mpm::Sweep::whole({scene.cells[1], scene.cells[0] + 1, 1, true});
  const double dt = 5e-6, body_acceleration[2] = {0, 8e-3};
  return operations_of(
      [&] {
        kernel.map_velocity(all);
        kernel.update_stress_and_accelerate(all, body_acceleration, dt);
        kernel.take_and_move(all, 1, dt);
      },
      points.size(), 0);
}

}  // namespace bench
