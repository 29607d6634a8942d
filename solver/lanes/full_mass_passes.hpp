#pragma once

#include "solver/kernel/isa.hpp"
#include "solver/lanes/lane_particles.hpp"
#include "solver/lanes/line_mass.hpp"
#include "solver/step/passes.hpp"

namespace mpm {

/// The state of a simulation with the consistent mass of a plane in the vector kernels, and the passes of its
/// leapfrog. What is done seldom, the general passes do: the start, resets, and what readers ask for.
template <class Basis>
class FullMassPasses {
 public:
  FullMassPasses(const Scene& scene, const Scheme& scheme, int threads)
      : scene_(scene),
        grid_(scene_, Basis::degree),
        layout_(scene_, grid_, Basis::degree),
        general_(scene, scheme, FullMass{}),
        team_(threads),
        wall_values_(grid_.size(), Vec2::Zero()) {
    for (const double m : general_.state().mass) total_mass_ += m;
    const std::vector<PointState> points = points_of(general_.state(), layout_);
    const Fluid& fluid = scene_.fluid;
    FullMassSetup setup{
        {Basis::degree,
         false,
         {line_of_cells(layout_.axis(0), functions_[0]), line_of_cells(layout_.axis(1), functions_[1])},
         fluid.rheology,
         needs_gradients(scene_),
         fluid.pressure,
         false,
         {{fluid.bulk_modulus, 1 / fluid.density}, 0},
         0,
         points.data(),
         points.size(),
         1},
        {line_mass(layout_.axis(0)), line_mass(layout_.axis(1))},
        {},
        negligible_mass,
        &team_};
    const int along = layout_.axis(0).count();
    for (int j = 0; j < layout_.axis(1).count(); ++j)
      for (int i = 0; i < along; ++i)
        if (general_.walls().is_wall(layout_.grid_index(i, j))) setup.wall_nodes.push_back(j * along + i);
    kernel_ = make_full_mass_kernel(setup);
    for (const int wall : setup.wall_nodes)
      walls_.push_back(
          {layout_.grid_index(wall % along, wall / along), wall / along * kernel_->stride() + wall % along});
  }

  [[nodiscard]] const std::optional<std::string>& breakdown() const { return breakdown_; }
  [[nodiscard]] const Vec2& impulse() const { return impulse_; }
  [[nodiscard]] const Particles& particles() const {
    gather();
    return general_.state();
  }
  [[nodiscard]] Grid mapped_grid(double t) const {
    gather();
    return general_.mapped_grid(t);
  }

  void reset_if_due(double t, double dt) {
    if (breakdown_ || !general_.reset_is_due(dt, [&] { return kernel_->largest_strain_rate(); })) return;
    gather();
    general_.reset(t + dt);
    general_.update_stress(0);
    const std::vector<PointState> points = points_of(general_.state(), layout_);
    kernel_->house(points.data(), points.size());
  }

  // The passes of step_leapfrog().

  void drift(double, double dt) {
    is_stale_ = true;
    const Motion motion = kernel_->drift(dt);
    if (!breakdown_) breakdown_ = breakdown_of(motion);
  }
  void particles_to_grid(double t) {
    prescribe([&](VectorField& v) { general_.walls().impose_velocity(v, t); });
    const Balance momentum = kernel_->project();
    impulse_ += found(momentum) - asked(momentum);
  }
  /// The kernel does by itself.
  void keep_start_velocity() {}
  /// Velocity at the middle of the step, by Euler.
  void half_kick(double t, double dt) { kick(Kick::ToMiddle, t, t, dt / 2); }
  /// The whole kick with the forces at the middle of the step.
  void kick_from_middle(double t, double dt) {
    const Balance force = kick(Kick::Whole, t, t + dt / 2, dt);
    impulse_ += dt * (total_mass_ * body_acceleration(t + dt / 2) + found(force) - asked(force));
  }
  void grid_to_particles(double) { kernel_->take(); }
  void close_drift(double t, double dt) { drift(t, dt); }

 private:
  /// With the body force at a time, and walls that get from t to t + dt.
  Balance kick(Kick which, double t, double time_of_force, double dt) {
    prescribe([&](VectorField& a) { general_.walls().impose_mean_acceleration(a, t, dt); });
    const Vec2 b = body_acceleration(time_of_force);
    const double of_kernel[2] = {b[layout_.axis_of(0)], b[layout_.axis_of(1)]};
    return kernel_->kick(which, of_kernel, dt);
  }

  [[nodiscard]] Vec2 body_acceleration(double t) const {
    return scene_.body_acceleration ? scene_.body_acceleration(t) : Vec2(Vec2::Zero());
  }

  template <class Impose>
  void prescribe(const Impose& impose) {
    if (walls_.empty()) return;
    impose(wall_values_);
    for (const Wall& wall : walls_)
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

  void gather() const {
    if (!is_stale_) return;
    std::vector<PointState> points(general_.state().size());
    kernel_->gather(points.data());
    take_points(points, layout_, general_.state());
    is_stale_ = false;
  }

  struct Wall {
    std::size_t in_grid;
    int in_kernel;
  };

  const Scene scene_;  // its own: whoever made it may be gone
  Grid grid_;          // geometry alone
  LaneLayout layout_;
  mutable Passes<Basis, FullMass> general_;
  mutable bool is_stale_ = false;  // the general particles
  std::array<std::vector<double>, 2> functions_;
  ThreadTeam team_;
  std::unique_ptr<FullMassKernel> kernel_;
  std::vector<Wall> walls_;
  VectorField wall_values_;
  double total_mass_ = 0;
  Vec2 impulse_ = Vec2::Zero();
  std::optional<std::string> breakdown_;
};

}  // namespace mpm
