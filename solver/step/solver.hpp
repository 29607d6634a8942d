#pragma once

#include <numbers>
#include <optional>

#include "solver/grid/boundary.hpp"
#include "solver/material/stress_update.hpp"
#include "solver/scene/seeding.hpp"
#include "solver/simulation.hpp"
#include "solver/step/nodal_forces.hpp"
#include "solver/transfer/motion.hpp"
#include "solver/transfer/particle_reset.hpp"
#include "solver/transfer/straight_drift.hpp"
#include "solver/transfer/transfer.hpp"
#include "solver/viscosity/implicit_viscosity.hpp"

namespace mpm {

/// The material point method. A time step reads top to bottom in one of the step_ functions; each call in
/// them is one loop over particles or nodes, or one linear solve.
template <class Basis, class Transfer>
class Solver final : public Simulation {
 public:
  Solver(const Scene& scene, const Scheme& scheme, const Transfer& transfer)
      : scene_(scene),
        stepping_(scheme.stepping),
        transfer_(transfer),
        particles_(seed_particles(scene)),
        grid_(scene_, Basis::degree),
        walls_(scene_, grid_),
        mass_(grid_, walls_),
        update_stress_(make_stress_update<Basis>(scene.fluid)) {
    if (stepping_ == Scheme::Stepping::ImplicitEuler || stepping_ == Scheme::Stepping::ImplicitSdirk2)
      implicit_viscosity_ = make_implicit_viscosity(scene.fluid.rheology, grid_, walls_);
    if (scheme.resets()) reset_.emplace(scene_, scheme, grid_, walls_);
    start();
    (*update_stress_)(particles_, grid_, grid_.velocity, 0);
  }

  void advance(double t, double dt) override {
    step(t, dt);
    if (reset_ && !breakdown_ && reset_->due(grid_, particles_, dt)) {
      (*reset_)(t + dt, walls_, grid_, particles_);
      (*update_stress_)(particles_, grid_, grid_.velocity, 0);
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

  [[nodiscard]] Totals totals() const override { return totals_of(particles_, impulse_); }

 private:
  using Mass = typename Transfer::Mass;

  void step(double t, double dt) {
    switch (stepping_) {
      case Scheme::Stepping::Usf:
        return step_usf(t, dt);
      case Scheme::Stepping::Usl:
        return step_usl(t, dt);
      case Scheme::Stepping::Musl:
        return step_musl(t, dt);
      case Scheme::Stepping::Leapfrog:
        return step_leapfrog(t, dt);
      case Scheme::Stepping::ImplicitEuler:
        return step_implicit_euler(t, dt);
      case Scheme::Stepping::ImplicitSdirk2:
        return step_implicit_sdirk2(t, dt);
    }
  }

  /// The grid with the particles' velocity mapped to it and the walls' imposed.
  [[nodiscard]] Grid mapped_grid(double t) const {
    Grid grid = grid_;
    Mass mass(grid, walls_);
    StencilTable table;
    map_velocity(t, grid, grid.velocity, mass, table);
    return grid;
  }

  /// Update stress first: strain rate from the velocity at the start of the step.
  void step_usf(double t, double dt) {
    particles_to_grid(t);
    (*update_stress_)(particles_, grid_, grid_.velocity, dt);
    forces(t);
    accelerate(t, dt);
    grid_to_particles(dt);
    move_with_grid(dt);
  }

  /// Update stress last: strain rate from the nodal velocity at the end of the step.
  void step_usl(double t, double dt) {
    particles_to_grid(t);
    forces(t);
    accelerate(t, dt);
    grid_to_particles(dt);
    (*update_stress_)(particles_, grid_, grid_.velocity, dt);
    move_with_grid(dt);
  }

  /// Modified update stress last: strain rate from the updated particles mapped back to the grid, with the
  /// shape functions of the start of the step.
  void step_musl(double t, double dt) {
    particles_to_grid(t);
    forces(t);
    accelerate(t, dt);
    grid_to_particles(dt);
    map_velocity(t + dt, grid_, grid_.mapped, mass_, table_);
    (*update_stress_)(particles_, grid_, grid_.mapped, dt);
    move_with_grid(dt);
  }

  /// Second order: half a drift of positions and densities, a kick of the velocities by the explicit midpoint
  /// rule, half a drift (Strang splitting). Without viscosity it is the leapfrog (Stoermer-Verlet), which
  /// holds sound waves neutrally stable; without sound it is the midpoint rule for the viscous stress.
  void step_leapfrog(double t, double dt) {
    drift(t, dt / 2);
    particles_to_grid(t);
    start_velocity_ = grid_.velocity;
    half_kick(t, dt);
    (*update_stress_)(particles_, grid_, grid_.velocity, 0);
    forces(t + dt / 2);
    solve_acceleration([&](VectorField& a) { walls_.impose_mean_acceleration(a, t, dt); });
    impulse_ += dt * (body_force_ + mass_.wall_force(grid_, walls_));
    set_velocity(start_velocity_, dt);
    grid_to_particles(dt);
    close_drift(t + dt, dt / 2);
  }

  /// Viscosity by backward Euler, pressure as in USF: bounded by sound alone.
  void step_implicit_euler(double t, double dt) {
    particles_to_grid(t);
    start_velocity_ = grid_.velocity;
    update_stress_->compress(particles_, grid_, grid_.velocity, dt);
    update_stress_->set_pressure(particles_);
    forces(t + dt);
    const Vec2 wall_impulse = solve_viscosity(start_velocity_, t + dt, dt);
    impulse_ += dt * body_force_ + wall_impulse;
    accelerate_between(start_velocity_, dt);
    grid_to_particles(dt);
    move_with_grid(dt);
  }

  /// As the leapfrog, with the kick by a singly diagonally implicit Runge-Kutta rule of two stages (Alexander
  /// 1977): second order, L-stable, so that an impulsive start dies out at once.
  void step_implicit_sdirk2(double t, double dt) {
    constexpr double gamma = 1 - 0.5 * std::numbers::sqrt2;
    constexpr double carry = (1 - gamma) / gamma;
    drift(t, dt / 2);
    particles_to_grid(t);
    start_velocity_ = grid_.velocity;
    update_stress_->set_pressure(particles_);

    forces(t + gamma * dt);
    Vec2 wall_impulse = carry * solve_viscosity(start_velocity_, t + gamma * dt, gamma * dt);
    Vec2 body_impulse = (1 - gamma) * dt * body_force_;
    stage_velocity_ = start_velocity_;
    for (std::size_t i = 0; i < grid_.size(); ++i)
      stage_velocity_[i] += carry * (grid_.velocity[i] - start_velocity_[i]);

    forces(t + dt);
    wall_impulse += solve_viscosity(stage_velocity_, t + dt, gamma * dt);
    body_impulse += gamma * dt * body_force_;

    impulse_ += body_impulse + wall_impulse;
    accelerate_between(start_velocity_, dt);
    grid_to_particles(dt);
    close_drift(t + dt, dt / 2);
  }

  /// Brings the walls' velocity at the start into the particles. Projections that hand particles the grid's
  /// velocity do it by themselves; others give them the wall nodes' share of the jump, as FLIP hands them
  /// every later change of a node.
  void start() {
    if constexpr (std::is_same_v<Mass, ConsistentMass>) {
      map_velocity(scene_.start, grid_, grid_.velocity, mass_, table_);
      grid_to_particles(0);
      if (needs_gradients(scene_)) take_gradients<Basis>(grid_, particles_);
    } else {
      if constexpr (std::is_same_v<Transfer, Apic>) particles_.affine = initial_gradients(scene_, particles_);
      const VectorField jump = walls_.initial_jump(grid_);
      for (std::size_t p = 0; p < particles_.size(); ++p)
        transfer_.template take_jump<Basis>(grid_, jump, particles_, p);
      map_velocity(scene_.start, grid_, grid_.velocity, mass_, table_);
    }
  }

  /// P2G at the start of a step. What imposing the walls' velocity changes reaches the particles in so far as
  /// they take the grid's velocity: an impulse of the walls.
  void particles_to_grid(double t) {
    const Vec2 momentum = map_velocity(t, grid_, grid_.velocity, mass_, table_);
    if (transfer_.grid_fraction() > 0) {
      Vec2 imposed = -momentum;
      for (std::size_t i = 0; i < grid_.size(); ++i) imposed += grid_.mass[i] * grid_.velocity[i];
      impulse_ += transfer_.grid_fraction() * imposed;
    }
  }

  /// m_i = sum_p N_ip m_p (paper Eq. 14), momentum likewise, and the nodal velocity that the mass makes of
  /// it, with the walls' velocity at t. Returns the total momentum.
  Vec2 map_velocity(double t, Grid& grid, VectorField& velocity, Mass& mass, StencilTable& table) const {
    std::fill(grid.mass.begin(), grid.mass.end(), 0.0);
    std::fill(velocity.begin(), velocity.end(), Vec2::Zero());
    for (std::size_t p = 0; p < particles_.size(); ++p)
      transfer_.template add_momentum<Basis>(Stencil<Basis>(grid, particles_.position[p]), particles_, p,
                                             grid.mass, velocity);
    Vec2 total = Vec2::Zero();
    for (const Vec2& momentum : velocity) total += momentum;
    if (mass.needs_table() || implicit_viscosity_) table.assign<Basis>(grid, particles_);
    mass.template assemble<Basis>(table, grid, particles_);
    mass.solve(grid, velocity, [&](VectorField& v) { walls_.impose_velocity(v, t); });
    return total;
  }

  /// Body forces at time t [s], and those of the particles' stress.
  void forces(double t) {
    std::fill(grid_.force.begin(), grid_.force.end(), Vec2::Zero());
    body_force_ =
        add_body_forces(grid_, scene_.body_acceleration ? scene_.body_acceleration(t) : Vec2(Vec2::Zero()));
    if (scene_.acceleration_field) {
      particle_acceleration_.resize(particles_.size());
      scene_.acceleration_field(particles_.position, t, particle_acceleration_);
      body_force_ += add_particle_forces<Basis>(grid_, particles_, particle_acceleration_);
    }
    add_stress_forces<Basis>(grid_, particles_);
  }

  /// a = M^-1 f, prescribed on walls; then v_i += dt a_i.
  void accelerate(double t, double dt) {
    solve_acceleration([&](VectorField& a) { walls_.impose_acceleration(a, t); });
    impulse_ += dt * (body_force_ + mass_.wall_force(grid_, walls_));
    for (std::size_t i = 0; i < grid_.size(); ++i) grid_.velocity[i] += dt * grid_.acceleration[i];
  }

  template <class Impose>
  void solve_acceleration(Impose&& impose) {
    grid_.acceleration = grid_.force;
    mass_.solve(grid_, grid_.acceleration, impose, Nodal::Acceleration);
  }

  /// Velocity at the middle of the step, by Euler.
  void half_kick(double t, double dt) {
    (*update_stress_)(particles_, grid_, grid_.velocity, 0);
    forces(t);
    solve_acceleration([&](VectorField& a) { walls_.impose_mean_acceleration(a, t, dt / 2); });
    if constexpr (Transfer::keeps_velocity) {
      mass_.template remap<Basis>(grid_, particles_, grid_.acceleration);
      walls_.impose_mean_acceleration(grid_.acceleration, t, dt / 2);
    }
    set_velocity(start_velocity_, dt / 2);
  }

  void set_velocity(const VectorField& start, double dt) {
    for (std::size_t i = 0; i < grid_.size(); ++i) grid_.velocity[i] = start[i] + dt * grid_.acceleration[i];
  }

  /// Solves M (v - start) = dt (f + viscous force of v) with the walls' velocity at t, from the present nodal
  /// velocity. Returns the impulse of the walls.
  Vec2 solve_viscosity(const VectorField& start, double t, double dt) {
    walls_.impose_velocity(grid_.velocity, t);
    const ImplicitSolution solution = implicit_viscosity_->solve(table_, particles_, mass_.matrix(grid_),
                                                                 start, grid_.force, dt, grid_.velocity);
    if (!solution.converged) breakdown_ = "the implicit viscosity did not converge";
    return solution.wall_impulse;
  }

  void accelerate_between(const VectorField& start, double dt) {
    for (std::size_t i = 0; i < grid_.size(); ++i)
      grid_.acceleration[i] = (grid_.velocity[i] - start[i]) / dt;
  }

  /// The particles take from the grid what the transfer gives them.
  void grid_to_particles(double dt) {
    for (std::size_t p = 0; p < particles_.size(); ++p)
      transfer_.template take<Basis>(grid_, dt, particles_, p);
  }

  /// Moves the particles and compresses them with the velocity that they have at t, mapped where they are.
  void drift(double t, double dt) {
    if constexpr (Transfer::is_grid_field) return drift_straight(dt);
    map_velocity(t, grid_, grid_.velocity, mass_, table_);
    drift_on(dt);
  }

  /// The same with the nodal velocity that stands.
  void drift_on(double dt) {
    update_stress_->compress(particles_, grid_, grid_.velocity, dt);
    move_with_grid(dt);
  }

  /// The second half of a drift, with the velocity that the particles have at the end of the step.
  void close_drift(double t, double dt) {
    if constexpr (Transfer::is_grid_field) {
      if (needs_gradients(scene_)) take_gradients<Basis>(grid_, particles_);
      return drift_straight(dt);
    }
    if constexpr (Transfer::keeps_velocity) map_velocity(t, grid_, grid_.velocity, mass_, table_);
    drift_on(dt);
  }

  /// The same for particles whose velocity is the grid's: along straight lines, without another projection.
  void drift_straight(double dt) {
    if (needs_gradients(scene_)) strain_straight(particles_, dt);
    judge(move_particles(grid_, particles_, dt, [&](std::size_t p) { return particles_.velocity[p]; }));
  }

  /// Particles follow the interpolated grid velocity (the paper's Eq. 20 uses their own).
  void move_with_grid(double dt) {
    judge(move_particles(grid_, particles_, dt, [&](std::size_t p) {
      return interpolate<Basis>(grid_, grid_.velocity, particles_.position[p]);
    }));
  }

  void judge(const Motion& motion) {
    if (!breakdown_) breakdown_ = breakdown_of(motion);
  }

  const Scene scene_;  // its own: whoever made it may be gone
  Scheme::Stepping stepping_;
  Transfer transfer_;
  Particles particles_;
  Grid grid_;
  WallNodes walls_;
  Mass mass_;
  StencilTable table_;
  std::unique_ptr<StressUpdate> update_stress_;
  std::optional<ParticleReset<Basis, Transfer>> reset_;
  std::unique_ptr<ImplicitViscosity> implicit_viscosity_;
  VectorField start_velocity_, stage_velocity_, particle_acceleration_;
  Vec2 body_force_ = Vec2::Zero(), impulse_ = Vec2::Zero();
  std::optional<std::string> breakdown_;
};

}  // namespace mpm
