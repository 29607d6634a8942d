#pragma once

#include <cmath>

#include "solver/scene/seeding.hpp"
#include "solver/transfer/consistent_mass.hpp"
#include "solver/transfer/reset_clock.hpp"
#include "solver/transfer/straight_drift.hpp"
#include "solver/transfer/transfer.hpp"

namespace mpm {

/// Puts the particles back on the lattice that they were seeded on, with what the grid knows of the fluid. A
/// flow that stretches fluid thins particles out along its stagnation lines until cells are empty; these
/// fluids carry no history but density, so new particles may take the place of old ones:
///   velocity and density are projected with the consistent mass (walls' velocity imposed), sampled on the
///   lattice, and mended by a part in 1e5 or so, so that total mass and momentum are those of before.
/// Every particle's mass becomes its density times its share of the domain.
template <class Basis>
class ParticleReset {
 public:
  /// is_grid_field: of the transfer (transfer.hpp).
  ParticleReset(const Scene& scene, const Scheme& scheme, const Grid& grid, const WallNodes& walls,
                bool is_grid_field)
      : clock_(scheme),
        takes_gradients_(is_grid_field && needs_gradients(scene)),
        velocity_mass_(grid, walls),
        density_mass_(grid) {
    const Particles seeded = seed_particles(scene);
    position_ = seeded.position;
    mass_ = sum(seeded.mass);
    for (std::size_t p = 0; p < seeded.size(); ++p) volume_.push_back(seeded.mass[p] / seeded.density[p]);
    // One away from walls, falling to zero on them: what may be added to a velocity without moving a wall.
    weight_.assign(grid.size(), Vec2::Ones());
    for (std::size_t i = 0; i < grid.size(); ++i)
      if (walls.is_wall(i)) weight_[i].setZero();
  }

  /// As ResetClock.
  template <class StrainRate>
  [[nodiscard]] bool due(double dt, const StrainRate& strain_rate) {
    return clock_.due(dt, strain_rate);
  }

  /// Resets the particles at time t [s]; uses the grid's masses and velocities as work space and leaves the
  /// projected velocity there.
  void operator()(double t, const WallNodes& walls, Grid& grid, Particles& particles) {
    clock_.restart();
    project(t, walls, grid, particles);
    const Vec2 momentum = total_momentum(particles);
    const bool is_affine = !takes_gradients_ && !particles.affine.empty();
    for (std::size_t p = 0; p < particles.size(); ++p) {
      particles.position[p] = position_[p];
      particles.density[p] = interpolate<Basis>(grid, density_, position_[p]).x();
      particles.velocity[p] = interpolate<Basis>(grid, grid.velocity, position_[p]);
      if (is_affine) particles.affine[p] = Apic::affine_field<Basis>(grid, grid.velocity, position_[p]);
      particles.mass[p] = particles.density[p] * volume_[p];
    }
    if (takes_gradients_) take_gradients<Basis>(grid, particles);
    keep_mass(particles);
    keep_momentum(momentum, grid, particles);
  }

  /// sqrt(2 D:D) where it is largest [1/s].
  [[nodiscard]] static double largest_strain_rate(const Grid& grid, const Particles& particles) {
    double largest = 0;
    for (const Vec2& x_p : particles.position) {
      const Mat2 l = gradient<Basis>(grid, grid.velocity, x_p);
      largest = std::max(largest, 0.5 * (l + l.transpose()).squaredNorm());
    }
    return std::sqrt(largest);
  }

 private:
  void project(double t, const WallNodes& walls, Grid& grid, const Particles& particles) {
    std::fill(grid.mass.begin(), grid.mass.end(), 0.0);
    std::fill(grid.velocity.begin(), grid.velocity.end(), Vec2::Zero());
    density_.assign(grid.size(), Vec2::Zero());
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const double m_p = particles.mass[p];
      Stencil<Basis>(grid, particles.position[p]).values([&](std::size_t i, double n) {
        grid.mass[i] += n * m_p;
        grid.velocity[i] += n * m_p * particles.velocity[p];
        density_[i].x() += n * m_p * particles.density[p];
      });
    }
    if (velocity_mass_.needs_table()) table_.assign<Basis>(grid, particles);
    velocity_mass_.template assemble<Basis>(table_, grid, particles);
    velocity_mass_.solve(grid, grid.velocity, [&](VectorField& v) { walls.impose_velocity(v, t); });
    density_mass_.template assemble<Basis>(table_, grid, particles);
    density_mass_.solve(grid, density_, [](VectorField&) {});
  }

  [[nodiscard]] static double sum(const ScalarField& field) {
    double total = 0;
    for (const double value : field) total += value;
    return total;
  }
  [[nodiscard]] static Vec2 total_momentum(const Particles& particles) {
    Vec2 total = Vec2::Zero();
    for (std::size_t p = 0; p < particles.size(); ++p) total += particles.mass[p] * particles.velocity[p];
    return total;
  }

  void keep_mass(Particles& particles) const {
    const double factor = mass_ / sum(particles.mass);
    for (std::size_t p = 0; p < particles.size(); ++p) {
      particles.mass[p] *= factor;
      particles.density[p] *= factor;
    }
  }

  void keep_momentum(const Vec2& momentum, const Grid& grid, Particles& particles) const {
    ScalarField weight(particles.size());
    double weighted_mass = 0;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      weight[p] = interpolate<Basis>(grid, weight_, particles.position[p]).x();
      weighted_mass += particles.mass[p] * weight[p];
    }
    if (!(weighted_mass > 0)) return;  // every function belongs to a wall
    const Vec2 missing = (momentum - total_momentum(particles)) / weighted_mass;
    for (std::size_t p = 0; p < particles.size(); ++p) particles.velocity[p] += weight[p] * missing;
  }

  ResetClock clock_;
  bool takes_gradients_;
  double mass_ = 0;  // of all particles at the start, which nothing changes [kg/m]
  VectorField position_;
  ScalarField volume_;  // [m2]
  VectorField weight_, density_;
  ConsistentMass velocity_mass_, density_mass_;
  StencilTable table_;
};

}  // namespace mpm
