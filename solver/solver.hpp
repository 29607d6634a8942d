#pragma once

#include <cmath>

#include "solver/basis.hpp"
#include "solver/boundary.hpp"
#include "solver/seeding.hpp"
#include "solver/simulation.hpp"
#include "solver/stress_update.hpp"
#include "solver/transfer.hpp"

namespace mpm {

/// The explicit material point method with lumped mass. A time step reads top to bottom in the three step_
/// functions; each call in them is one loop over particles or nodes.
template <class Basis, class Transfer>
class Solver final : public Simulation {
 public:
  Solver(const Scene& scene, Scheme::Stepping stepping)
      : scene_(scene),
        stepping_(stepping),
        particles_(seed_particles(scene)),
        grid_(scene, Basis::degree),
        walls_(scene, grid_),
        update_stress_(make_stress_update<Basis>(scene.fluid)) {
    walls_.template start_impulsively<Basis>(grid_, particles_);
    map_velocity(grid_, grid_.velocity);
    walls_.impose_velocity(grid_.velocity, 0);
    (*update_stress_)(particles_, grid_, grid_.velocity, 0);
  }

  void advance(double t, double dt) override {
    switch (stepping_) {
      case Scheme::Stepping::Usf:
        return step_usf(t, dt);
      case Scheme::Stepping::Usl:
        return step_usl(t, dt);
      case Scheme::Stepping::Musl:
        return step_musl(t, dt);
    }
  }

  [[nodiscard]] std::optional<std::string> breakdown() const override { return breakdown_; }
  [[nodiscard]] const Particles& particles() const override { return particles_; }

  [[nodiscard]] VectorField grid_field(const VectorField& points, double t) const override {
    const Grid grid = mapped_grid(t);
    VectorField velocities;
    velocities.reserve(points.size());
    for (const Vec2& point : points) velocities.push_back(interpolate<Basis>(grid, grid.velocity, point));
    return velocities;
  }

  [[nodiscard]] std::vector<Mat2> grid_gradient(const VectorField& points, double t) const override {
    const Grid grid = mapped_grid(t);
    std::vector<Mat2> gradients;
    gradients.reserve(points.size());
    for (const Vec2& point : points) gradients.push_back(gradient<Basis>(grid, grid.velocity, point));
    return gradients;
  }

  [[nodiscard]] Totals totals() const override {
    Totals sum{0, Vec2::Zero(), impulse_, 0};
    for (std::size_t p = 0; p < particles_.size(); ++p) {
      sum.mass += particles_.mass[p];
      sum.momentum += particles_.mass[p] * particles_.velocity[p];
      sum.kinetic_energy += 0.5 * particles_.mass[p] * particles_.velocity[p].squaredNorm();
    }
    return sum;
  }

 private:
  /// The grid with the particles' velocity mapped to it and the walls' imposed.
  [[nodiscard]] Grid mapped_grid(double t) const {
    Grid grid = grid_;
    map_velocity(grid, grid.velocity);
    walls_.impose_velocity(grid.velocity, t);
    return grid;
  }

  /// Update stress first: strain rate from the velocity at the start of the step.
  void step_usf(double t, double dt) {
    map_velocity(grid_, grid_.velocity);
    walls_.impose_velocity(grid_.velocity, t);
    (*update_stress_)(particles_, grid_, grid_.velocity, dt);
    forces(t);
    accelerate(t, dt);
    update_velocities(dt);
    move_particles(dt);
  }

  /// Update stress last: strain rate from the nodal velocity at the end of the step.
  void step_usl(double t, double dt) {
    map_velocity(grid_, grid_.velocity);
    walls_.impose_velocity(grid_.velocity, t);
    forces(t);
    accelerate(t, dt);
    update_velocities(dt);
    (*update_stress_)(particles_, grid_, grid_.velocity, dt);
    move_particles(dt);
  }

  /// Modified update stress last: strain rate from the updated particles mapped back to the grid, with the
  /// shape functions of the start of the step.
  void step_musl(double t, double dt) {
    map_velocity(grid_, grid_.velocity);
    walls_.impose_velocity(grid_.velocity, t);
    forces(t);
    accelerate(t, dt);
    update_velocities(dt);
    map_velocity(grid_, grid_.mapped);
    walls_.impose_velocity(grid_.mapped, t + dt);
    (*update_stress_)(particles_, grid_, grid_.mapped, dt);
    move_particles(dt);
  }

  /// m_i = sum_p N_ip m_p (paper Eq. 14) and v_i = sum_p N_ip m_p v_p / m_i. A node without mass stays at
  /// rest.
  void map_velocity(Grid& grid, VectorField& velocity) const {
    std::fill(grid.mass.begin(), grid.mass.end(), 0.0);
    std::fill(velocity.begin(), velocity.end(), Vec2::Zero());
    for (std::size_t p = 0; p < particles_.size(); ++p) {
      const double m_p = particles_.mass[p];
      const Vec2 v_p = particles_.velocity[p];
      Stencil<Basis>(grid, particles_.position[p]).values([&](std::size_t i, double n) {
        grid.mass[i] += n * m_p;
        velocity[i] += n * m_p * v_p;
      });
    }
    for (std::size_t i = 0; i < grid.size(); ++i)
      if (grid.mass[i] > 0) velocity[i] /= grid.mass[i];
  }

  /// f_i = m_i b - sum_p (m_p/rho_p) sigma_p grad N_ip (paper Eq. 17).
  void forces(double t) {
    const Vec2 b = scene_.body_acceleration ? scene_.body_acceleration(t) : Vec2(Vec2::Zero());
    body_force_ = Vec2::Zero();
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      grid_.force[i] = grid_.mass[i] * b;
      body_force_ += grid_.force[i];
    }
    for (std::size_t p = 0; p < particles_.size(); ++p) {
      const Mat2 volume_stress = (particles_.mass[p] / particles_.density[p]) * particles_.stress[p];
      Stencil<Basis>(grid_, particles_.position[p]).gradients([&](std::size_t i, const Vec2& dn) {
        grid_.force[i] -= volume_stress * dn;
      });
    }
  }

  /// a_i = f_i/m_i, prescribed on walls; then v_i += dt a_i.
  void accelerate(double t, double dt) {
    for (std::size_t i = 0; i < grid_.size(); ++i)
      grid_.acceleration[i] = grid_.mass[i] > 0 ? Vec2(grid_.force[i] / grid_.mass[i]) : Vec2(Vec2::Zero());
    const Vec2 wall_force = walls_.impose_acceleration(grid_, t);
    impulse_ += dt * (body_force_ + wall_force);
    for (std::size_t i = 0; i < grid_.size(); ++i) grid_.velocity[i] += dt * grid_.acceleration[i];
  }

  void update_velocities(double dt) {
    for (std::size_t p = 0; p < particles_.size(); ++p) {
      const Vec2 a_p = interpolate<Basis>(grid_, grid_.acceleration, particles_.position[p]);
      particles_.velocity[p] = Transfer::update(particles_.velocity[p], dt * a_p);
    }
  }

  /// Particles follow the interpolated grid velocity (the paper's Eq. 20 uses their own); x in periodic
  /// directions wraps. The same loop finds a state that cannot be continued from.
  void move_particles(double dt) {
    double energy = 0;
    bool inside = true, dense = true;
    for (std::size_t p = 0; p < particles_.size(); ++p) {
      Vec2& x_p = particles_.position[p];
      x_p += dt * interpolate<Basis>(grid_, grid_.velocity, x_p);
      inside &= grid_.x.contain(x_p.x()) && grid_.y.contain(x_p.y());
      dense &= particles_.density[p] > 0;
      energy += particles_.velocity[p].squaredNorm();
    }
    if (!std::isfinite(energy))
      breakdown_ = "velocity is not finite";
    else if (!inside)
      breakdown_ = "a particle left the domain";
    else if (!dense)
      breakdown_ = "density is not positive";
  }

  const Scene& scene_;
  Scheme::Stepping stepping_;
  Particles particles_;
  Grid grid_;
  WallNodes walls_;
  std::unique_ptr<StressUpdate> update_stress_;
  Vec2 body_force_ = Vec2::Zero(), impulse_ = Vec2::Zero();
  std::optional<std::string> breakdown_;
};

}  // namespace mpm
