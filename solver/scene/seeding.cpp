#include "solver/scene/seeding.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>

namespace mpm {
namespace {

/// P_n(z) and its derivative by the three-term recurrence.
std::pair<double, double> legendre(int n, double z) {
  double p = 1, before = 0;
  for (int k = 1; k <= n; ++k) {
    const double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
    before = p;
    p = next;
  }
  return {p, n * (z * p - before) / (z * z - 1)};
}

/// Positions [m] and masses per length, relative to density, of all particles along one axis.
struct LineOfParticles {
  std::vector<double> position, length;
};

LineOfParticles row_along(const Scene& scene, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  const int n = scene.particles_per_cell[a];
  const double total = scene.size[axis];
  const CellPoints points = cell_points(scene.seeding.rule[a], n);
  LineOfParticles row;
  for (int cell = 0; cell < scene.cells[a]; ++cell)
    for (std::size_t k = 0; k < points.position.size(); ++k) {
      const double x = (cell + points.position[k]) * total / scene.cells[a];
      const double shifted = x + scene.seeding.shift[a] * total / scene.cells[a];
      row.position.push_back(scene.seeding.shift[a] == 0 ? x : shifted - total * std::floor(shifted / total));
      row.length.push_back(points.weight[k] * total / scene.cells[a]);
    }
  return row;
}

/// Uniform in [-1, 1): the top 53 bits of two draws, because the standard distributions differ between
/// libraries.
double random_sign_and_size(std::mt19937& generator) {
  const std::uint64_t high = generator(), low = generator();
  return 2 * (static_cast<double>((high << 21) ^ (low >> 11)) * 0x1p-53) - 1;
}

/// Folds a displaced coordinate back: around a periodic direction, or by reflection at a wall.
double put_back(double x, double length, bool periodic) {
  if (x >= 0 && x <= length) return x;
  if (periodic) return x < 0 ? x + length : x - length;
  return x < 0 ? -x : 2 * length - x;
}

}  // namespace

CellPoints cell_points(Seeding::Rule rule, int n) {
  CellPoints points;
  for (int i = 0; i < n; ++i) {
    if (rule == Seeding::Rule::Even) {
      points.position.push_back((i + 0.5) / n);
      points.weight.push_back(1.0 / n);
      continue;
    }
    double z = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    for (int iteration = 0; iteration < 10; ++iteration) {  // from this start four suffice
      const auto [p, slope] = legendre(n, z);
      z -= p / slope;
    }
    const double slope = legendre(n, z).second;
    points.position.push_back(0.5 * (1 + z));
    points.weight.push_back(1 / ((1 - z * z) * slope * slope));
  }
  return points;
}

Particles seed_particles(const Scene& scene) {
  const LineOfParticles along_x = row_along(scene, 0), along_y = row_along(scene, 1);
  const Vec2 reach =
      scene.seeding.displacement * Vec2(scene.size.x() / static_cast<double>(along_x.position.size()),
                                        scene.size.y() / static_cast<double>(along_y.position.size()));
  std::mt19937 generator(scene.seeding.seed);
  Particles particles;
  for (std::size_t j = 0; j < along_y.position.size(); ++j) {
    for (std::size_t i = 0; i < along_x.position.size(); ++i) {
      Vec2 x(along_x.position[i], along_y.position[j]);
      if (scene.seeding.displacement > 0)
        for (int axis : {0, 1})
          x[axis] = put_back(x[axis] + reach[axis] * random_sign_and_size(generator), scene.size[axis],
                             scene.periodic(axis));
      if (scene.free_surface && !scene.free_surface->is_fluid(x)) continue;
      particles.position.push_back(x);
      particles.velocity.push_back(scene.initial_velocity ? scene.initial_velocity(x) : Vec2(Vec2::Zero()));
      const double density = scene.initial_density ? scene.initial_density(x) : scene.fluid.density;
      particles.mass.push_back(density * along_x.length[i] * along_y.length[j]);
      particles.density.push_back(density);
      particles.stress.push_back(Mat2::Zero());
    }
  }
  if (particles.size() == 0) throw SceneError("no particle lies in the region that the fluid fills");
  return particles;
}

std::vector<Mat2> initial_gradients(const Scene& scene, const Particles& particles) {
  std::vector<Mat2> gradients(particles.size(), Mat2::Zero());
  if (!scene.initial_velocity) return gradients;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    for (int axis : {0, 1}) {
      Vec2 step = Vec2::Zero();
      step[axis] = 1e-4 * scene.cell_size(axis);
      const Vec2 x = particles.position[p];
      gradients[p].col(axis) =
          (scene.initial_velocity(x + step) - scene.initial_velocity(x - step)) / (2 * step[axis]);
    }
  }
  return gradients;
}

}  // namespace mpm
