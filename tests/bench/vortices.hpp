#pragma once

#include <cmath>
#include <numbers>

#include "solver/simulation.hpp"
#include "tests/bench/plain/plain_full_mass.hpp"

// What solver and plain loops are given of Taylor-Green vortices in a periodic box, Re 100, c = 20 U.
namespace bench {

constexpr double speed = 1, sound = 20 * speed;  // [m/s]
constexpr plain::Box vortex_box{1, 0, 1000, 1000 * sound* sound / 7, 10};

inline mpm::Scene vortices(int cells) {
  mpm::Scene scene;
  scene.size = {vortex_box.length, vortex_box.length};
  scene.cells = {cells, cells};
  scene.fluid.density = vortex_box.density;
  scene.fluid.bulk_modulus = vortex_box.bulk_modulus;
  scene.fluid.rheology = mpm::Newtonian{vortex_box.viscosity};
  scene.initial_velocity = [](const mpm::Vec2& x) {
    constexpr double k = 2 * std::numbers::pi;
    return mpm::Vec2(std::sin(k * x.x()) * std::cos(k * x.y()), -std::cos(k * x.x()) * std::sin(k * x.y()));
  };
  return scene;
}

/// A third of a cell of sound [s].
inline double sonic_step(int cells) {
  return 0.3 / cells / sound;
}

/// A plain loop that starts with the particles of a simulation.
template <class Loop>
Loop plain_loop(int cells, const mpm::Particles& particles) {
  plain::Box box = vortex_box;
  box.cells = cells;
  std::vector<plain::Point> points(particles.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    points[p].mass = particles.mass[p];
    points[p].volume = particles.mass[p] / particles.density[p];
    for (int c : {0, 1}) {
      points[p].x[c] = particles.position[p][c];
      points[p].v[c] = particles.velocity[p][c];
      for (int axis : {0, 1}) points[p].l[c][axis] = particles.affine[p](c, axis);
    }
  }
  return Loop(box, std::move(points));
}

}  // namespace bench
