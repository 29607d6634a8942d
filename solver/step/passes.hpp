#pragma once

#include <memory>
#include <optional>

#include "solver/grid/boundary.hpp"
#include "solver/material/stress_update.hpp"
#include "solver/scene/seeding.hpp"
#include "solver/step/nodal_forces.hpp"
#include "solver/step/stage_rates.hpp"
#include "solver/transfer/motion.hpp"
#include "solver/transfer/particle_reset.hpp"
#include "solver/transfer/straight_drift.hpp"
#include "solver/transfer/transfer.hpp"
#include "solver/viscosity/implicit_viscosity.hpp"

namespace mpm {

/// The state of a simulation, and what a step is made of: each function is one loop over particles or nodes,
/// or one linear solve, over everything.
template <class Basis, class Transfer>
class Passes {
 public:
  using Mass = typename Transfer::Mass;

  Passes(const Scene& scene, const Scheme& scheme, const Transfer& transfer)
      : scene_(scene),
        transfer_(transfer),
        particles_(seed_particles(scene)),
        grid_(scene_, Basis::degree),
        walls_(scene_, grid_),
        mass_(grid_, walls_),
        has_cell_dilatation_(scheme.dilatation == Scheme::Dilatation::Cell),
        update_stress_(make_stress_update<Basis>(scene, scheme)) {
    using Stepping = Scheme::Stepping;
    if (scheme.stepping == Stepping::ImplicitEuler || scheme.stepping == Stepping::ImplicitSdirk2)
      implicit_viscosity_ = make_implicit_viscosity(scene.fluid.rheology, grid_, walls_);
    if (scheme.resets()) reset_.emplace(scene_, scheme, grid_, walls_, Transfer::is_grid_field);
    start();
    update_stress(0);
  }

  [[nodiscard]] const Particles& particles() const { return particles_; }
  [[nodiscard]] const Vec2& impulse() const { return impulse_; }
  [[nodiscard]] const std::optional<std::string>& breakdown() const { return breakdown_; }

  /// The grid with the particles' velocity mapped to it and the walls' imposed.
  [[nodiscard]] const Grid& mapped_grid(double t) const {
    // Beside the state, and kept: to lay out a consistent mass costs as much as a dozen steps of a strip.
    if (!sampled_) sampled_ = std::make_unique<Sampled>(grid_, walls_);
    map_velocity(t, sampled_->grid, sampled_->grid.velocity, sampled_->mass, sampled_->table);
    return sampled_->grid;
  }

  /// Puts the particles back on their lattice where that is due, after a step from t to t + dt.
  void reset_if_due(double t, double dt) {
    if (breakdown_) return;
    if (!reset_is_due(dt, [&] { return reset_->largest_strain_rate(grid_, particles_); })) return;
    reset(t + dt);
    update_stress(0);
  }

  // The state, for whoever steps it with passes of his own and leaves to these what is done seldom.
  [[nodiscard]] Particles& state() { return particles_; }
  [[nodiscard]] const WallNodes& walls() const { return walls_; }
  template <class StrainRate>
  [[nodiscard]] bool reset_is_due(double dt, const StrainRate& strain_rate) {
    return reset_ && reset_->due(dt, strain_rate);
  }
  void reset(double t) { (*reset_)(t, walls_, grid_, particles_); }

  /// The passes of a step from t to t + dt, as the explicit rules call them.
  struct Stage {
    Passes& passes;
    double t, dt;

    void particles_to_grid() { passes.particles_to_grid(t); }
    void update_stress() { passes.update_stress(dt); }
    void update_stress_from_mapped() {
      (*passes.update_stress_)(passes.particles_, passes.grid_, passes.grid_.mapped, dt);
    }
    void accelerate() {
      passes.forces(t);
      passes.accelerate(t, dt);
    }
    void update_stress_and_accelerate() {
      update_stress();
      accelerate();
    }
    void take() { passes.grid_to_particles(dt); }
    void map_updated_velocity() {
      passes.map_velocity(t + dt, passes.grid_, passes.grid_.mapped, passes.mass_, passes.table_);
    }
    void move() { passes.move_with_grid(dt); }
    void take_and_move() {
      take();
      move();
    }
  };

  /// All stages one after another.
  template <class... Part>
  void in_turn(double t, double dt, const Part&... part) {
    Stage stage{*this, t, dt};
    (part(stage), ...);
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

  /// Body forces at time t [s], and those of the particles' stress.
  void forces(double t) {
    std::fill(grid_.force.begin(), grid_.force.end(), Vec2::Zero());
    const Vec2 body = scene_.body_acceleration ? scene_.body_acceleration(t) : Vec2(Vec2::Zero());
    body_force_ = add_body_forces(grid_, body);
    if (scene_.acceleration_field) {
      particle_acceleration_.resize(particles_.size());
      scene_.acceleration_field(particles_.position, t, particle_acceleration_);
      body_force_ += add_particle_forces<Basis>(grid_, particles_, particle_acceleration_);
    }
    if (implicit_viscosity_ && !scene_.fluid.pressure) {  // no stress but the viscous one
    } else if (has_cell_dilatation_)
      add_cell_stress_forces<Basis>(grid_, particles_, cell_tension_);
    else
      add_stress_forces(grid_, particles_, [&](std::size_t p) {
        if constexpr (reads_table)
          return table_.stencil(p);
        else
          return Stencil<Basis>(grid_, particles_.position[p]);
      });
    if (scene_.free_surface) relieve_light_nodes(grid_, body, scene_.least_nodal_mass());
  }

  /// Density over dt and stress from the nodal velocity; dt = 0 sets the stress of the present state.
  void update_stress(double dt) { (*update_stress_)(particles_, grid_, grid_.velocity, dt); }
  void compress(double dt) { update_stress_->compress(particles_, grid_, grid_.velocity, dt); }
  void set_pressure() { update_stress_->set_pressure(particles_); }

  /// a = M^-1 f, prescribed on walls; then v_i += dt a_i.
  void accelerate(double t, double dt) {
    solve_acceleration([&](VectorField& a) { walls_.impose_acceleration(a, t); });
    walls_.add_drag(grid_, t, dt);
    impulse_ += dt * (body_force_ + mass_.wall_force(grid_, walls_));
    for (std::size_t i = 0; i < grid_.size(); ++i) grid_.velocity[i] += dt * grid_.acceleration[i];
  }

  /// What the nodal velocity was when a kick began; the rules come back to it.
  void keep_start_velocity() { start_velocity_ = grid_.velocity; }
  [[nodiscard]] const VectorField& start_velocity() const { return start_velocity_; }
  [[nodiscard]] const Vec2& body_force() const { return body_force_; }
  void add_impulse(const Vec2& impulse) { impulse_ += impulse; }

  /// start + carry (v - start).
  const VectorField& carried_velocity(double carry) {
    stage_velocity_ = start_velocity_;
    for (std::size_t i = 0; i < grid_.size(); ++i)
      stage_velocity_[i] += carry * (grid_.velocity[i] - start_velocity_[i]);
    return stage_velocity_;
  }

  /// Velocity at the middle of the step, by Euler.
  void half_kick(double t, double dt) {
    update_stress(0);
    forces(t);
    solve_acceleration([&](VectorField& a) { walls_.impose_mean_acceleration(a, t, dt / 2); });
    if constexpr (!Transfer::is_grid_field)
      if (keeps_velocity()) {
        mass_.template remap<Basis>(grid_, particles_, grid_.acceleration);
        walls_.impose_mean_acceleration(grid_.acceleration, t, dt / 2);
      }
    set_velocity(start_velocity_, dt / 2);
  }

  /// The whole kick with the forces at the middle of the step.
  void kick_from_middle(double t, double dt) {
    update_stress(0);
    forces(t + dt / 2);
    solve_acceleration([&](VectorField& a) { walls_.impose_mean_acceleration(a, t, dt); });
    impulse_ += dt * (body_force_ + mass_.wall_force(grid_, walls_));
    set_velocity(start_velocity_, dt);
  }

  /// Solves M (v - start) = dt (f + viscous force of v) with the walls' velocity at t. `beyond`: how far this
  /// time lies after that of the last solution, in units of the last one's after the one before. Returns the
  /// impulse of the walls.
  Vec2 solve_viscosity(const VectorField& start, double t, double dt, double beyond) {
    // Beside a plug the iteration ends where its steps stop falling (YieldNewton), which they may do for a
    // while that close to the solution: measured 3e-7 of a plug's height.
    if (!std::holds_alternative<HerschelBulkley>(scene_.fluid.rheology))
      rates_.guess(start, dt, beyond, grid_.velocity);
    walls_.impose_velocity(grid_.velocity, t);
    const ImplicitSolution solution = implicit_viscosity_->solve(table_, particles_, mass_.matrix(grid_),
                                                                 start, grid_.force, dt, grid_.velocity);
    if (!solution.converged) breakdown_ = "the implicit viscosity did not converge";
    rates_.keep(start, dt, grid_.velocity);
    return solution.wall_impulse;
  }

  /// The acceleration that has led to the nodal velocity.
  void accelerate_from_start(double dt) {
    for (std::size_t i = 0; i < grid_.size(); ++i)
      grid_.acceleration[i] = (grid_.velocity[i] - start_velocity_[i]) / dt;
  }

  /// The particles take from the grid what the transfer gives them.
  void grid_to_particles(double dt) {
    if constexpr (keeps_table && std::is_same_v<Transfer, FullMass>)
      for (std::size_t p = 0; p < particles_.size(); ++p) particles_.velocity[p] = velocity_by_table(p);
    else
      transfer_.template take<Basis>(grid_, dt, particles_);
  }

  /// Moves the particles and compresses them with the velocity that they have at t, mapped where they are.
  void drift(double t, double dt) {
    if constexpr (Transfer::is_grid_field) return drift_straight(dt);
    map_velocity(t, grid_, grid_.velocity, mass_, table_);
    drift_on(dt);
  }

  /// The second half of a drift, with the velocity that the particles have at the end of the step.
  void close_drift(double t, double dt) {
    if constexpr (Transfer::is_grid_field) {
      if (needs_gradients(scene_)) take_gradients<Basis>(grid_, particles_);
      return drift_straight(dt);
    }
    if (keeps_velocity()) map_velocity(t, grid_, grid_.velocity, mass_, table_);
    drift_on(dt);
  }

  /// Particles follow the interpolated grid velocity (the paper's Eq. 20 uses their own).
  void move_with_grid(double dt) {
    judge(move_particles(grid_, particles_, dt, [&](std::size_t p) {
      if constexpr (keeps_table)
        return velocity_by_table(p);
      else
        return interpolate<Basis>(grid_, grid_.velocity, particles_.position[p]);
    }));
  }

 private:
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

  /// m_i = sum_p N_ip m_p (paper Eq. 14), momentum likewise, and the nodal velocity that the mass makes of
  /// it, with the walls' velocity at t. Returns the total momentum.
  Vec2 map_velocity(double t, Grid& grid, VectorField& velocity, Mass& mass, StencilTable& table) const {
    std::fill(grid.mass.begin(), grid.mass.end(), 0.0);
    std::fill(velocity.begin(), velocity.end(), Vec2::Zero());
    if (keeps_table || mass.needs_table() || implicit_viscosity_) table.assign<Basis>(grid, particles_);
    for (std::size_t p = 0; p < particles_.size(); ++p) {
      if constexpr (reads_table)
        transfer_.template add_momentum<Basis>(table.stencil(p), particles_, p, grid.mass, velocity);
      else
        transfer_.template add_momentum<Basis>(Stencil<Basis>(grid, particles_.position[p]), particles_, p,
                                               grid.mass, velocity);
    }
    Vec2 total = Vec2::Zero();
    for (const Vec2& momentum : velocity) total += momentum;
    mass.template assemble<Basis>(table, grid, particles_);
    mass.solve(grid, velocity, [&](VectorField& v) { walls_.impose_velocity(v, t); });
    return total;
  }

  template <class Impose>
  void solve_acceleration(Impose&& impose) {
    grid_.acceleration = grid_.force;
    mass_.solve(grid_, grid_.acceleration, impose, Nodal::Acceleration);
  }

  void set_velocity(const VectorField& start, double dt) {
    for (std::size_t i = 0; i < grid_.size(); ++i) grid_.velocity[i] = start[i] + dt * grid_.acceleration[i];
  }

  /// The same with the nodal velocity that stands.
  void drift_on(double dt) {
    update_stress_->compress(particles_, grid_, grid_.velocity, dt);
    move_with_grid(dt);
  }

  /// The same for particles whose velocity is the grid's: along straight lines, without another projection.
  void drift_straight(double dt) {
    if (needs_gradients(scene_)) strain_straight(particles_, dt);
    judge(move_particles(grid_, particles_, dt, [&](std::size_t p) { return particles_.velocity[p]; }));
  }

  /// Whether a part of the particles' velocity stays their own.
  [[nodiscard]] bool keeps_velocity() const { return transfer_.grid_fraction() < 1; }

  void judge(const Motion& motion) {
    if (!breakdown_) breakdown_ = breakdown_of(motion);
  }

  /// The grid's velocity where a particle was when its momentum was mapped last.
  [[nodiscard]] Vec2 velocity_by_table(std::size_t p) const {
    Vec2 v = Vec2::Zero();
    table_.stencil(p).values([&](std::size_t i, double n) { v += n * grid_.velocity[i]; });
    return v;
  }

  /// Whether stencils are written out whatever else needs them: on a strip, where they stand as long as rows
  /// slide. And whether the transfer reads them (APIC asks for offsets too).
  static constexpr bool keeps_table = Basis::X::support == 1;
  static constexpr bool reads_table = keeps_table && !std::is_same_v<Transfer, Apic>;

  const Scene scene_;  // its own: whoever made it may be gone
  Transfer transfer_;
  Particles particles_;
  Grid grid_;
  WallNodes walls_;
  Mass mass_;
  StencilTable table_;
  /// Where mapped_grid() maps to.
  struct Sampled {
    Sampled(const Grid& of, const WallNodes& walls) : grid(of), mass(grid, walls) {}
    Grid grid;
    Mass mass;
    StencilTable table;
  };
  mutable std::unique_ptr<Sampled> sampled_;
  bool has_cell_dilatation_;
  ScalarField cell_tension_;
  std::unique_ptr<StressUpdate> update_stress_;
  std::optional<ParticleReset<Basis>> reset_;
  std::unique_ptr<ImplicitViscosity> implicit_viscosity_;
  StageRates rates_;
  VectorField start_velocity_, stage_velocity_, particle_acceleration_;
  Vec2 body_force_ = Vec2::Zero(), impulse_ = Vec2::Zero();
  std::optional<std::string> breakdown_;
};

}  // namespace mpm
