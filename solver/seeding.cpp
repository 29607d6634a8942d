#include "solver/seeding.hpp"

namespace mpm {

Particles seed_particles(const Scene& scene) {
  const int nx = scene.cells[0] * scene.particles_per_cell[0];
  const int ny = scene.cells[1] * scene.particles_per_cell[1];
  const Vec2 spacing(scene.size.x() / nx, scene.size.y() / ny);
  const double mass = scene.fluid.density * spacing.x() * spacing.y();
  Particles particles;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const Vec2 x((i + 0.5) * spacing.x(), (j + 0.5) * spacing.y());
      particles.position.push_back(x);
      particles.velocity.push_back(scene.initial_velocity ? scene.initial_velocity(x) : Vec2(Vec2::Zero()));
      particles.mass.push_back(mass);
      particles.density.push_back(scene.fluid.density);
      particles.stress.push_back(Mat2::Zero());
    }
  }
  return particles;
}

}  // namespace mpm
