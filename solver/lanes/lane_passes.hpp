#pragma once

#include "solver/grid/stencil.hpp"
#include "solver/kernel/isa.hpp"
#include "solver/lanes/lane_particles.hpp"
#include "solver/lanes/lane_walls.hpp"
#include "solver/particles.hpp"
#include "solver/scene/seeding.hpp"
#include "solver/step/explicit_steps.hpp"
#include "solver/transfer/motion.hpp"
#include "solver/transfer/transfer.hpp"

namespace mpm {

/// The state of a simulation in the vector kernels, and the passes of its explicit steps: loops over
/// particles and nodes are the kernel's; walls and forces from outside are told here.
template <class Basis>
class LanePasses {
 public:
  LanePasses(const Scene& scene, const Scheme& scheme, double flip_fraction, int threads)
      : scene_(scene),
        stepping_(scheme.stepping),
        dilatation_(scheme.dilatation),
        flip_fraction_(flip_fraction),
        is_affine_(scheme.transfer == Scheme::Transfer::Apic),
        grid_(scene_, Basis::degree),
        layout_(scene_, grid_, Basis::degree),
        team_(threads),
        sweep_(layout_.lines(), stages_of(scheme.stepping)),
        wall_nodes_(scene_, grid_),
        walls_(scene_, grid_, wall_nodes_, layout_, sweep_.shares()),
        slips_(walls_.slip()),
        particles_(started_particles()),
        kernel_(started_kernel()),
        nodes_(kernel_->nodes()) {
    for (const double m : particles_.mass) total_mass_ += m;
    update_all_stress(scene.start);
    is_stale_ = true;
  }

  /// Geometry alone.
  [[nodiscard]] const Grid& grid() const { return grid_; }
  [[nodiscard]] const Vec2& impulse() const { return impulse_; }
  [[nodiscard]] const std::optional<std::string>& breakdown() const { return breakdown_; }

  /// In the order of seeding, written out from the kernel when it has moved on.
  [[nodiscard]] const Particles& particles() const {
    if (is_stale_) gather_particles();
    return particles_;
  }

  /// The particles' velocity mapped to the grid with the walls' imposed, as Grid numbers nodes.
  [[nodiscard]] VectorField mapped_velocity(double t) const {
    map_all(t);
    VectorField velocity(grid_.size());
    for (int j = 0; j < layout_.axis(1).count(); ++j)
      for (int i = 0; i < layout_.axis(0).count(); ++i)
        for (int c : {0, 1})
          velocity[layout_.grid_index(i, j)][layout_.axis_of(c)] = nodes_.velocity[c][layout_.node(i, j)];
    return velocity;
  }

  /// What acts on the fluid from outside in a step.
  struct Drive {
    double dt;
    double body_acceleration[2];  ///< by component of the kernel
    LaneWalls::Values wall_velocity, wall_acceleration;
    LaneWalls::Values wall_velocity_at_end;  ///< where the step has a use for it
  };

  /// The passes of a step over a part of the grid, as the explicit rules call them.
  struct Stage {
    LanePasses& passes;
    const Part& part;
    const Drive& drive;

    /// P2G at the start of a step. What the walls impose reaches the particles in so far as they take the
    /// grid's velocity.
    void particles_to_grid() {
      passes.kernel_->map_velocity(part);
      passes.walls_.impose_velocity(part, drive.wall_velocity, passes.nodes_, 1 - passes.flip_fraction_);
    }
    void update_stress() { passes.kernel_->update_stress(part, NodalVelocity::Current, drive.dt); }
    void update_stress_from_mapped() { passes.kernel_->update_stress(part, NodalVelocity::Mapped, drive.dt); }
    /// With the stress that the particles have.
    void accelerate() {
      passes.kernel_->accelerate(part, drive.body_acceleration, drive.dt);
      impose_acceleration();
    }
    void update_stress_and_accelerate() {
      passes.kernel_->update_stress_and_accelerate(part, drive.body_acceleration, drive.dt);
      impose_acceleration();
    }
    void take() { passes.kernel_->take(part, passes.flip_fraction_, drive.dt); }
    void map_updated_velocity() {
      passes.kernel_->map_updated_velocity(part);
      passes.walls_.impose_velocity(part, drive.wall_velocity_at_end, passes.nodes_.mapped);
    }
    void move() { passes.kernel_->move(part, drive.dt); }
    void take_and_move() { passes.kernel_->take_and_move(part, passes.flip_fraction_, drive.dt); }

   private:
    void impose_acceleration() {
      passes.walls_.impose_acceleration(part, drive.wall_acceleration, passes.nodes_, drive.dt);
      if (passes.slips_) passes.walls_.add_drag(part, drive.wall_velocity_at_end, passes.nodes_, drive.dt);
    }
  };

  /// All stages in one sweep, then what is left to do when all particles have moved.
  template <class... Pass>
  void in_turn(double t, double dt, const Pass&... pass) {
    is_stale_ = true;
    time_ = t + dt;
    const Drive drive = drive_of(t, dt);
    const auto on_part = [&](const auto& whole) {
      return [&](const Part& part) {
        Stage stage{*this, part, drive};
        whole(stage);
      };
    };
    sweep_.run(team_, on_part(pass)...);
    settle(drive);
  }

 private:
  [[nodiscard]] Drive drive_of(double t, double dt) const {
    const Vec2 b = scene_.body_acceleration ? scene_.body_acceleration(t) : Vec2(Vec2::Zero());
    return {dt,
            {b[layout_.axis_of(0)], b[layout_.axis_of(1)]},
            walls_.velocity(t),
            walls_.acceleration(t),
            slips_ || stepping_ == Scheme::Stepping::Musl ? walls_.velocity(t + dt) : LaneWalls::Values{}};
  }

  /// What is left to do when all particles have moved.
  void settle(const Drive& drive) {
    const Motion motion = kernel_->settle();
    if (!breakdown_) breakdown_ = breakdown_of(motion);
    for (int c : {0, 1}) impulse_[layout_.axis_of(c)] += drive.dt * total_mass_ * drive.body_acceleration[c];
    impulse_ += walls_.take_impulse();
  }

  /// P2G of everything with the walls' velocity at t.
  void map_all(double t) const {
    const Part all = Sweep::whole(layout_.lines());
    kernel_->map_velocity(all);
    walls_.impose_velocity(all, walls_.velocity(t), nodes_.velocity);
  }

  /// The stress of the present state everywhere.
  void update_all_stress(double t) const {
    map_all(t);
    kernel_->update_stress(Sweep::whole(layout_.lines()), NodalVelocity::Current, 0);
  }

  /// Seeded, with the walls' share of an impulsive start.
  [[nodiscard]] Particles started_particles() const {
    Particles particles = seed_particles(scene_);
    const VectorField jump = wall_nodes_.initial_jump(grid_);
    if (is_affine_) particles.affine = initial_gradients(scene_, particles);
    for (std::size_t p = 0; p < particles.size(); ++p) {
      if (is_affine_)
        Apic{}.take_jump<Basis>(grid_, jump, particles, p);
      else
        particles.velocity[p] += interpolate<Basis>(grid_, jump, particles.position[p]);
    }
    return particles;
  }

  [[nodiscard]] std::unique_ptr<Kernel> started_kernel() {
    const std::vector<PointState> points = points_of(particles_, layout_);
    std::array<std::vector<double>, 2> functions;
    const Fluid& fluid = scene_.fluid;
    KernelSetup setup{Basis::degree,
                      layout_.is_strip(),
                      {},
                      fluid.rheology,
                      is_affine_,
                      stepping_ != Scheme::Stepping::Usf,
                      fluid.pressure,
                      dilatation_ == Scheme::Dilatation::Cell,
                      {{fluid.bulk_modulus, 1 / fluid.density}, scene_.least_density()},
                      1 / scene_.least_nodal_mass(),
                      points.data(),
                      points.size(),
                      sweep_.shares()};
    for (int c : {0, 1})
      setup.axis[static_cast<std::size_t>(c)] =
          line_of_cells(layout_.axis(c), functions[static_cast<std::size_t>(c)]);
    return make_kernel(setup);
  }

  /// Update stress first keeps no stress: a reader gets that of the present state.
  void gather_particles() const {
    if (stepping_ == Scheme::Stepping::Usf) update_all_stress(time_);
    std::vector<PointState> points(particles_.size());
    kernel_->gather(points.data());
    take_points(points, layout_, particles_);
    is_stale_ = false;
  }

  const Scene scene_;  // its own: whoever made it may be gone
  Scheme::Stepping stepping_;
  Scheme::Dilatation dilatation_;
  double flip_fraction_;
  bool is_affine_;
  Grid grid_;  // geometry alone
  LaneLayout layout_;
  ThreadTeam team_;
  Sweep sweep_;
  WallNodes wall_nodes_;
  LaneWalls walls_;
  bool slips_;
  mutable Particles particles_;  // a copy, for readers
  mutable bool is_stale_ = false;
  std::unique_ptr<Kernel> kernel_;
  NodeFields nodes_;
  double total_mass_ = 0, time_ = 0;
  Vec2 impulse_ = Vec2::Zero();
  std::optional<std::string> breakdown_;
};

}  // namespace mpm
