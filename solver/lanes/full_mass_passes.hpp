#pragma once

#include "solver/grid/boundary.hpp"
#include "solver/grid/matrices/sparse_pattern.hpp"
#include "solver/kernel/isa.hpp"
#include "solver/lanes/lane_particles.hpp"
#include "solver/lanes/line_mass.hpp"
#include "solver/scene/seeding.hpp"
#include "solver/simulation.hpp"
#include "solver/transfer/motion.hpp"
#include "solver/transfer/reset_clock.hpp"
#include "solver/transfer/straight_drift.hpp"

namespace mpm {

/// The state of a simulation with the consistent mass of a plane in the vector kernels, and the passes of its
/// leapfrog.
template <class Basis>
class FullMassPasses {
 public:
  FullMassPasses(const Scene& scene, const Scheme& scheme, int threads)
      : scene_(scene),
        grid_(scene_, Basis::degree),
        layout_(scene_, grid_, Basis::degree),
        walls_(scene_, grid_),
        clock_(scheme),
        team_(threads),
        particles_(seed_particles(scene)),
        lattice_(particles_.position),
        wall_values_(grid_.size(), Vec2::Zero()) {
    for (const double m : particles_.mass) total_mass_ += m;
    if (needs_gradients(scene_)) particles_.affine.assign(particles_.size(), Mat2::Zero());
    start_kernel(scheme.resets());
    start();
  }

  [[nodiscard]] const std::optional<std::string>& breakdown() const { return breakdown_; }
  [[nodiscard]] Totals totals() const {
    const KernelTotals sums = kernel_->totals();
    return {sums.mass, of_scene(sums.momentum), impulse_, sums.kinetic_energy};
  }
  [[nodiscard]] const Particles& particles() const {
    if (is_stale_) gather();
    return particles_;
  }
  /// The grid with the particles' velocity mapped to it and the walls' at t imposed.
  [[nodiscard]] const Grid& mapped_grid(double t) const {
    if (mapped_at_ == t) return grid_;
    prescribe([&](VectorField& v) { walls_.impose_velocity(v, t); });
    kernel_->project_aside();
    for (int j = 0; j < layout_.axis(1).count(); ++j)
      for (int i = 0; i < layout_.axis(0).count(); ++i)
        for (int c : {0, 1})
          grid_.velocity[layout_.grid_index(i, j)][layout_.axis_of(c)] = kernel_->velocity(c)[place_of(i, j)];
    mapped_at_ = t;
    return grid_;
  }

  void reset_if_due(double t, double dt) {
    if (breakdown_ || !clock_.due(dt, [&] { return kernel_->largest_strain_rate(); })) return;
    clock_.restart();
    prescribe([&](VectorField& v) { walls_.impose_velocity(v, t + dt); });
    kernel_->reset();
    is_stale_ = is_on_lattice_ = true;
    mapped_at_.reset();
  }

  // The passes of step_leapfrog().

  void drift(double, double dt) {
    is_stale_ = true;
    is_on_lattice_ = false;
    mapped_at_.reset();
    const Motion motion = kernel_->drift(dt);
    if (!breakdown_) breakdown_ = breakdown_of(motion);
  }
  void particles_to_grid(double t) {
    prescribe([&](VectorField& v) { walls_.impose_velocity(v, t); });
    const Balance momentum = kernel_->project();
    impulse_ += found(momentum) - asked(momentum);
    if (scene_.acceleration_field) locate_particles();
  }
  /// The kernel does by itself.
  void keep_start_velocity() {}
  /// Velocity at the middle of the step, by Euler.
  void half_kick(double t, double dt) { kick(Kick::ToMiddle, t, t, dt / 2); }
  /// The whole kick with the forces at the middle of the step.
  void kick_from_middle(double t, double dt) {
    const Balance force = kick(Kick::Whole, t, t + dt / 2, dt);
    impulse_ += dt * (body_force_ + found(force) - asked(force));
  }
  void grid_to_particles(double) { kernel_->take(); }
  void close_drift(double t, double dt) { drift(t, dt); }

 private:
  void start_kernel(bool resets) {
    const std::vector<PointState> points = points_of(particles_, layout_);
    std::array<std::vector<double>, 2> functions;
    const Fluid& fluid = scene_.fluid;
    const Axis &along = layout_.axis(0), &across = layout_.axis(1);
    FullMassSetup setup{
        {Basis::degree,
         false,
         {line_of_cells(along, functions[0]), line_of_cells(across, functions[1])},
         fluid.rheology,
         needs_gradients(scene_),
         true,
         fluid.pressure,
         false,
         {{fluid.bulk_modulus, 1 / fluid.density}, 0},
         0,
         points.data(),
         points.size(),
         1},
        {line_mass(along, true), line_mass(across, true)},
        resets ? std::array{line_mass(along, false), line_mass(across, false)} : std::array<LineMass, 2>{},
        {},
        resets,
        negligible_mass,
        &team_};
    for (int j = 0; j < across.count(); ++j)
      for (int i = 0; i < along.count(); ++i)
        if (walls_.is_wall(layout_.grid_index(i, j))) setup.wall_nodes.push_back(j * along.count() + i);
    kernel_ = make_full_mass_kernel(setup);
    for (const int wall : setup.wall_nodes) {
      const int i = wall % along.count(), j = wall / along.count();
      wall_nodes_.push_back({layout_.grid_index(i, j), place_of(i, j)});
    }
  }

  /// Brings the walls' velocity at the start into the particles.
  void start() {
    prescribe([&](VectorField& v) { walls_.impose_velocity(v, scene_.start); });
    kernel_->project_aside();
    kernel_->take();
    kernel_->set_stress();
  }

  /// With the body force at a time, and walls that get from t to t + dt.
  Balance kick(Kick which, double t, double time_of_force, double dt) {
    prescribe([&](VectorField& a) { walls_.impose_mean_acceleration(a, t, dt); });
    const Vec2 b = scene_.body_acceleration ? scene_.body_acceleration(time_of_force) : Vec2(Vec2::Zero());
    body_force_ = total_mass_ * b;
    if (scene_.acceleration_field) accelerate_particles(time_of_force);
    const double of_kernel[2] = {b[layout_.axis_of(0)], b[layout_.axis_of(1)]};
    return kernel_->kick(which, of_kernel, dt);
  }

  /// Where they are while the kicks last, in the order of the kernel.
  void locate_particles() {
    points_.resize(particles_.size());
    for (ScalarField& component : exchanged_) component.resize(particles_.size());
    double* const x[2] = {exchanged_[0].data(), exchanged_[1].data()};
    kernel_->positions(x);
    for (std::size_t p = 0; p < points_.size(); ++p)
      for (int c : {0, 1}) points_[p][layout_.axis_of(c)] = x[c][p];
  }
  void accelerate_particles(double t) {
    accelerations_.resize(points_.size());
    scene_.acceleration_field(points_, t, accelerations_);
    for (std::size_t c : {0, 1})
      for (std::size_t p = 0; p < points_.size(); ++p)
        exchanged_[c][p] = accelerations_[p][layout_.axis_of(static_cast<int>(c))];
    const double* const b[2] = {exchanged_[0].data(), exchanged_[1].data()};
    double force[2];
    kernel_->accelerate_particles(b, force);
    body_force_ += of_scene(force);
  }

  template <class Impose>
  void prescribe(const Impose& impose) const {
    if (wall_nodes_.empty()) return;
    impose(wall_values_);
    for (const WallNode& wall : wall_nodes_)
      for (int c : {0, 1})
        kernel_->prescribed(c)[wall.in_kernel] = wall_values_[wall.in_grid][layout_.axis_of(c)];
  }

  [[nodiscard]] Vec2 of_scene(const double (&components)[2]) const {
    Vec2 v;
    for (int c : {0, 1}) v[layout_.axis_of(c)] = components[c];
    return v;
  }
  [[nodiscard]] Vec2 asked(const Balance& balance) const { return of_scene(balance.asked); }
  [[nodiscard]] Vec2 found(const Balance& balance) const { return of_scene(balance.found); }

  /// Of the node that is the i-th along and the j-th across the lanes, in the kernel.
  [[nodiscard]] int place_of(int i, int j) const { return j * kernel_->stride() + i; }

  void gather() const {
    std::vector<PointState> points(particles_.size());
    kernel_->gather(points.data());
    take_points(points, layout_, particles_);
    if (is_on_lattice_) particles_.position = lattice_;  // to the last bit
    is_stale_ = false;
  }

  struct WallNode {
    std::size_t in_grid;
    int in_kernel;
  };

  const Scene scene_;  // its own: whoever made it may be gone
  mutable Grid grid_;  // with a velocity for readers
  LaneLayout layout_;
  WallNodes walls_;
  ResetClock clock_;
  ThreadTeam team_;
  mutable Particles particles_;  // a copy, for readers
  const VectorField lattice_;    // where they were seeded
  mutable bool is_stale_ = true;
  bool is_on_lattice_ = true;
  mutable std::optional<double> mapped_at_;  // the time [s] whose walls the grid's velocity has, if it stands
  std::unique_ptr<FullMassKernel> kernel_;
  std::vector<WallNode> wall_nodes_;
  mutable VectorField wall_values_;
  VectorField points_, accelerations_;    // of particles, in the order of the kernel
  std::array<ScalarField, 2> exchanged_;  // with the kernel, by its components
  double total_mass_ = 0;
  Vec2 body_force_ = Vec2::Zero(), impulse_ = Vec2::Zero();
  std::optional<std::string> breakdown_;
};

}  // namespace mpm
