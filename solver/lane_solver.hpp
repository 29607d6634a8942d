#pragma once

#include <span>
#include <utility>

#include "solver/boundary.hpp"
#include "solver/kernel/isa.hpp"
#include "solver/kernel/sweep.hpp"
#include "solver/motion.hpp"
#include "solver/seeding.hpp"
#include "solver/simulation.hpp"
#include "solver/stencil.hpp"

namespace mpm {

/// Whether a LaneSolver covers a scheme on a scene: lumped mass with particles that carry a velocity only,
/// explicit steps of first order, no acceleration that varies in space, no reset of particles.
inline bool lanes_cover(const Scene& scene, const Scheme& scheme) {
  using T = Scheme::Transfer;
  using S = Scheme::Stepping;
  const bool transfer =
      scheme.transfer == T::Flip || scheme.transfer == T::Pic || scheme.transfer == T::FlipBlend;
  const bool stepping = scheme.stepping == S::Usf || scheme.stepping == S::Usl || scheme.stepping == S::Musl;
  return transfer && stepping && !scene.acceleration_field && !scheme.resets();
}

/// The material point method on the vector kernels: the same schemes as Solver, an order of magnitude faster.
/// Loops over particles and nodes are the kernel's; walls, forces from outside and the order of a step are
/// told here.
template <class Basis>
class LaneSolver final : public Simulation {
 public:
  LaneSolver(const Scene& scene, Scheme::Stepping stepping, double flip_fraction, int threads)
      : scene_(scene),
        stepping_(stepping),
        flip_fraction_(flip_fraction),
        lane_axis_(lane_axis(scene)),
        grid_(scene, Basis::degree),
        walls_(scene, grid_),
        team_(threads),
        sweep_(lines(), stepping == Scheme::Stepping::Musl ? 4 : 3),
        wall_impulse_(static_cast<std::size_t>(sweep_.shares())),
        particles_(started_particles()),
        kernel_(started_kernel()),
        nodes_(kernel_->nodes()) {
    for (const double m : particles_.mass) total_mass_ += m;
    list_wall_nodes();
    map_all(scene.start);
    kernel_->update_stress(Sweep::whole(lines()), NodalVelocity::Current, 0);
    is_stale_ = true;
  }

  void advance(double t, double dt) override {
    is_stale_ = true;
    time_ = t + dt;
    switch (stepping_) {
      case Scheme::Stepping::Usl:
        return step_usl(t, dt);
      case Scheme::Stepping::Musl:
        return step_musl(t, dt);
      default:
        return step_usf(t, dt);
    }
  }

  [[nodiscard]] std::optional<std::string> breakdown() const override { return breakdown_; }

  /// In the order of seeding, written out from the kernel when it has moved on.
  [[nodiscard]] const Particles& particles() const override {
    if (is_stale_) gather_particles();
    return particles_;
  }

  [[nodiscard]] VectorField grid_field(const VectorField& points, double t) const override {
    const VectorField nodal = mapped_velocity(t);
    VectorField velocities;
    velocities.reserve(points.size());
    for (const Vec2& point : points) velocities.push_back(interpolate<Basis>(grid_, nodal, point));
    return velocities;
  }

  [[nodiscard]] std::vector<Mat2> grid_gradient(const VectorField& points, double t) const override {
    const VectorField nodal = mapped_velocity(t);
    std::vector<Mat2> gradients;
    gradients.reserve(points.size());
    for (const Vec2& point : points) gradients.push_back(gradient<Basis>(grid_, nodal, point));
    return gradients;
  }

  [[nodiscard]] Totals totals() const override { return totals_of(particles(), impulse_); }

 private:
  /// Update stress first: strain rate from the velocity at the start of the step.
  void step_usf(double t, double dt) {
    const Drive drive = drive_of(t, dt);
    sweep_.run(
        team_, [&](const Part& part) { particles_to_grid(part, drive); },
        [&](const Part& part) {
          kernel_->update_stress_and_accelerate(part, drive.body_acceleration, dt);
          impose_acceleration(part, drive);
        },
        [&](const Part& part) { kernel_->take_and_move(part, flip_fraction_, dt); });
    settle(drive);
  }

  /// Update stress last: strain rate from the nodal velocity at the end of the step.
  void step_usl(double t, double dt) {
    const Drive drive = drive_of(t, dt);
    sweep_.run(
        team_, [&](const Part& part) { particles_to_grid(part, drive); },
        [&](const Part& part) {
          kernel_->accelerate(part, drive.body_acceleration, dt);
          impose_acceleration(part, drive);
        },
        [&](const Part& part) {
          kernel_->update_stress(part, NodalVelocity::Current, dt);
          kernel_->take_and_move(part, flip_fraction_, dt);
        });
    settle(drive);
  }

  /// Modified update stress last: strain rate from the updated particles mapped back to the grid, with the
  /// shape functions of the start of the step.
  void step_musl(double t, double dt) {
    const Drive drive = drive_of(t, dt);
    const WallValues wall_at_end = wall_values(t + dt, &Side::velocity);
    sweep_.run(
        team_, [&](const Part& part) { particles_to_grid(part, drive); },
        [&](const Part& part) {
          kernel_->accelerate(part, drive.body_acceleration, dt);
          impose_acceleration(part, drive);
        },
        [&](const Part& part) {
          kernel_->take(part, flip_fraction_, dt);
          kernel_->map_updated_velocity(part);
          impose_velocity(part, wall_at_end, nodes_.mapped);
        },
        [&](const Part& part) {
          kernel_->update_stress(part, NodalVelocity::Mapped, dt);
          kernel_->move(part, dt);
        });
    settle(drive);
  }

  using WallValues = std::array<std::array<double, 2>, 4>;

  /// What acts on the fluid from outside in a step, by component of the kernel.
  struct Drive {
    double dt;
    double body_acceleration[2];
    WallValues wall_velocity, wall_acceleration;
  };
  [[nodiscard]] Drive drive_of(double t, double dt) const {
    const Vec2 b = scene_.body_acceleration ? scene_.body_acceleration(t) : Vec2(Vec2::Zero());
    return {dt,
            {b[axis_of(0)], b[axis_of(1)]},
            wall_values(t, &Side::velocity),
            wall_values(t, &Side::acceleration)};
  }

  /// Velocity or acceleration of every wall at t.
  WallValues wall_values(double t, std::function<Vec2(double)> Side::*quantity) const {
    WallValues values{};
    for (std::size_t edge = 0; edge < 4; ++edge) {
      const Side& side = scene_.sides[edge];
      if (side.periodic) continue;
      const Vec2 value = (side.*quantity)(t);
      for (int c : {0, 1}) values[edge][static_cast<std::size_t>(c)] = value[axis_of(c)];
    }
    return values;
  }

  /// P2G at the start of a step. What the walls impose reaches the particles in so far as they take the
  /// grid's velocity: an impulse of the walls.
  void particles_to_grid(const Part& part, const Drive& drive) {
    kernel_->map_velocity(part);
    const Impulse imposed = impose_velocity(part, drive.wall_velocity, nodes_.velocity);
    for (int c : {0, 1})
      wall_impulse_[static_cast<std::size_t>(part.share)].of[c] += (1 - flip_fraction_) * imposed.of[c];
  }

  /// Momentum by component of the kernel.
  struct alignas(64) Impulse {
    double of[2] = {0, 0};
  };

  /// Gives the wall nodes of a part the walls' velocity. Returns the momentum that this adds.
  Impulse impose_velocity(const Part& part, const WallValues& wall, double* const velocity[2]) const {
    Impulse imposed;
    for (const WallNode& node : wall_nodes(part.complete))
      for (int c : {0, 1}) {
        double& v = velocity[c][node.index];
        const double of_wall = wall[node.from[c]][static_cast<std::size_t>(c)], change = of_wall - v;
        if (const double inverse = nodes_.inverse_mass[node.index]; inverse > 0 && !node.is_image)
          imposed.of[c] += change / inverse;
        v = of_wall;
      }
    return imposed;
  }

  /// Gives the wall nodes of a part the walls' acceleration.
  void impose_acceleration(const Part& part, const Drive& drive) {
    Impulse& impulse = wall_impulse_[static_cast<std::size_t>(part.share)];
    for (const WallNode& node : wall_nodes(part.complete))
      for (int c : {0, 1}) {
        double& a = nodes_.acceleration[c][node.index];
        const double of_wall = drive.wall_acceleration[node.from[c]][static_cast<std::size_t>(c)],
                     change = of_wall - a;
        a = of_wall;
        nodes_.velocity[c][node.index] += drive.dt * change;
        if (const double inverse = nodes_.inverse_mass[node.index]; inverse > 0 && !node.is_image)
          impulse.of[c] += drive.dt * change / inverse;
      }
  }

  /// What is left to do when all particles have moved.
  void settle(const Drive& drive) {
    const Motion motion = kernel_->settle();
    if (!breakdown_) breakdown_ = breakdown_of(motion);
    for (int c : {0, 1}) {
      impulse_[axis_of(c)] += drive.dt * total_mass_ * drive.body_acceleration[c];
      for (Impulse& share : wall_impulse_) impulse_[axis_of(c)] += std::exchange(share.of[c], 0);
    }
  }

  /// P2G of everything with the walls' velocity at t.
  void map_all(double t) const {
    const Part all = Sweep::whole(lines());
    kernel_->map_velocity(all);
    impose_velocity(all, wall_values(t, &Side::velocity), nodes_.velocity);
  }

  /// A node on a wall, by its number in the kernel, and the sides that give its two components.
  struct WallNode {
    int index;
    bool is_image;  ///< of a periodic node that stands in the list, too
    std::size_t from[2];
  };
  [[nodiscard]] std::span<const WallNode> wall_nodes(Rows rows) const {
    const auto at = [&](int row) {
      return wall_nodes_.data() + first_wall_node_[static_cast<std::size_t>(row)];
    };
    return {at(rows.begin), at(rows.end)};
  }

  /// Lanes lie along the shorter side, so that the rows of nodes that a block touches stay in the cache,
  /// unless it is so short that the gap between its rows would waste lanes.
  static int lane_axis(const Scene& scene) {
    const int longer = scene.cells[1] >= scene.cells[0] ? 1 : 0;
    return scene.cells[static_cast<std::size_t>(1 - longer)] >= 16 ? 1 - longer : longer;
  }
  /// Component of the kernel <-> axis of the scene.
  [[nodiscard]] int axis_of(int c) const { return c == 0 ? lane_axis_ : 1 - lane_axis_; }
  [[nodiscard]] const Axis& axis(int c) const { return axis_of(c) == 0 ? grid_.x : grid_.y; }
  [[nodiscard]] bool is_strip() const { return axis(1).periodic && axis(1).cells == 1; }
  [[nodiscard]] Sweep::Lines lines() const {
    return {axis(1).cells, axis(0).cells + Basis::degree, is_strip() ? 0 : Basis::degree,
            axis(1).periodic && !is_strip()};
  }

  /// Seeded, with the walls' share of an impulsive start.
  [[nodiscard]] Particles started_particles() const {
    Particles particles = seed_particles(scene_);
    const VectorField jump = walls_.initial_jump(grid_);
    for (std::size_t p = 0; p < particles.size(); ++p)
      particles.velocity[p] += interpolate<Basis>(grid_, jump, particles.position[p]);
    return particles;
  }

  [[nodiscard]] std::unique_ptr<Kernel> started_kernel() {
    std::vector<PointState> points(particles_.size());
    for (std::size_t p = 0; p < points.size(); ++p)
      for (int c : {0, 1}) {
        points[p].position[c] = particles_.position[p][axis_of(c)];
        points[p].velocity[c] = particles_.velocity[p][axis_of(c)];
        points[p].mass = particles_.mass[p];
        points[p].density = particles_.density[p];
      }
    std::array<std::vector<double>, 2> polynomials;
    KernelSetup setup{Basis::degree,
                      is_strip(),
                      {},
                      scene_.fluid.rheology,
                      scene_.fluid.pressure,
                      {scene_.fluid.bulk_modulus, 1 / scene_.fluid.density},
                      points.data(),
                      points.size(),
                      sweep_.shares()};
    for (int c : {0, 1}) {
      const auto a = static_cast<std::size_t>(c);
      constexpr int size = (Basis::degree + 1) * (Basis::degree + 1);
      for (int cell = 0; cell < axis(c).cells; ++cell)
        polynomials[a].insert(polynomials[a].end(), axis(c).polynomials(cell),
                              axis(c).polynomials(cell) + size);
      setup.axis[a] = {axis(c).cells, axis(c).periodic, axis(c).length, axis(c).inverse_h,
                       polynomials[a].data()};
    }
    return make_kernel(setup);
  }

  /// Number in the kernel of the node with functions k along and l across the lanes, counted along the axes.
  [[nodiscard]] int node(int k, int l) const { return l * nodes_.stride + k; }

  void list_wall_nodes() {
    const std::vector<WallNodes::Node>& walls = walls_.nodes();
    std::vector<const WallNodes::Node*> wall_of(grid_.size(), nullptr);
    for (const WallNodes::Node& wall : walls) wall_of[wall.index] = &wall;
    for (int l = 0; l < nodes_.rows; ++l) {
      first_wall_node_.push_back(wall_nodes_.size());
      for (int k = 0; k < axis(0).cells + Basis::degree; ++k) {
        const int ij[2] = {axis(0).function(k), axis(1).function(l)};
        const WallNodes::Node* wall = wall_of[grid_index(ij[0], ij[1])];
        if (!wall) continue;
        const std::size_t from[2] = {static_cast<std::size_t>(wall->x_from),
                                     static_cast<std::size_t>(wall->y_from)};
        wall_nodes_.push_back({node(k, l), k != ij[0] || l != ij[1], {from[axis_of(0)], from[axis_of(1)]}});
      }
    }
    first_wall_node_.push_back(wall_nodes_.size());
  }

  /// Index in Grid of the node that is the i-th along and the j-th across the lanes.
  [[nodiscard]] std::size_t grid_index(int i, int j) const {
    const int x = lane_axis_ == 0 ? i : j, y = lane_axis_ == 0 ? j : i;
    return static_cast<std::size_t>(y * grid_.x.count() + x);
  }

  /// The particles' velocity mapped to the grid with the walls' imposed, as Grid numbers nodes.
  [[nodiscard]] VectorField mapped_velocity(double t) const {
    map_all(t);
    VectorField velocity(grid_.size());
    for (int j = 0; j < axis(1).count(); ++j)
      for (int i = 0; i < axis(0).count(); ++i)
        for (int c : {0, 1}) velocity[grid_index(i, j)][axis_of(c)] = nodes_.velocity[c][node(i, j)];
    return velocity;
  }

  /// Update stress first keeps no stress: a reader gets that of the present state.
  void gather_particles() const {
    if (stepping_ == Scheme::Stepping::Usf) {
      map_all(time_);
      kernel_->update_stress(Sweep::whole(lines()), NodalVelocity::Current, 0);
    }
    std::vector<PointState> points(particles_.size());
    kernel_->gather(points.data());
    for (std::size_t p = 0; p < points.size(); ++p) {
      for (int c : {0, 1}) {
        particles_.position[p][axis_of(c)] = points[p].position[c];
        particles_.velocity[p][axis_of(c)] = points[p].velocity[c];
        particles_.stress[p](axis_of(c), axis_of(c)) = points[p].stress[c];
      }
      particles_.density[p] = points[p].density;
      particles_.stress[p](0, 1) = particles_.stress[p](1, 0) = points[p].stress[2];
    }
    is_stale_ = false;
  }

  const Scene& scene_;
  Scheme::Stepping stepping_;
  double flip_fraction_;
  int lane_axis_;
  Grid grid_;  // geometry alone
  WallNodes walls_;
  ThreadTeam team_;
  Sweep sweep_;
  std::vector<Impulse> wall_impulse_;  // of the step, by share
  mutable Particles particles_;        // a copy, for readers
  mutable bool is_stale_ = false;
  std::unique_ptr<Kernel> kernel_;
  NodeFields nodes_;
  std::vector<WallNode> wall_nodes_;  // row by row
  std::vector<std::size_t> first_wall_node_;
  double total_mass_ = 0, time_ = 0;
  Vec2 impulse_ = Vec2::Zero();
  std::optional<std::string> breakdown_;
};

}  // namespace mpm
