#include "verification/runs/surface_record.hpp"

#include <algorithm>
#include <cmath>

namespace verification {

reports::SurfaceRow surface_at(const SceneConfig& config, const mpm::Simulation& simulation, double t) {
  const mpm::Scene& scene = config.scene;
  const mpm::Particles& particles = simulation.particles();
  const Vec2 body = scene.body_acceleration ? scene.body_acceleration(t) : Vec2(Vec2::Zero());
  const double specific = scene.fluid.bulk_modulus / scene.fluid.density;
  reports::SurfaceRow row;
  row.t = t;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2& x = particles.position[p];
    const double m = particles.mass[p], r = particles.density[p] / scene.fluid.density;
    row.front = std::max(row.front, x.x());
    if (x.x() < scene.cell_size(0)) row.column_height = std::max(row.column_height, x.y());
    row.kinetic_energy += 0.5 * m * particles.velocity[p].squaredNorm();
    row.potential_energy -= m * body.dot(x);
    row.elastic_energy += m * specific * ((std::pow(r, 6) - 1) / 6 + 1 / r - 1);
  }
  row.front += 0.5 * scene.cell_size(0) / scene.particles_per_cell[0];
  row.column_height += 0.5 * scene.cell_size(1) / scene.particles_per_cell[1];
  return row;
}

}  // namespace verification
