#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "solver/grid/grid.hpp"
#include "solver/scene/scene.hpp"

namespace mpm {

/// What a mass matrix is solved for: an iteration starts from the last solution of the same kind.
enum class Nodal { Velocity, Acceleration };

/// The nodes whose functions do not vanish on a wall: the first and the last along a direction with walls,
/// for every basis here. Their values are the field's values on the wall, so the wall prescribes them. In
/// a corner each wall prescribes the velocity normal to it, so that nothing is pushed through either (a lid
/// does not drag the corner through the wall beside it). Along a wall that lets the fluid slip nothing is
/// prescribed: there the wall drags.
class WallNodes {
 public:
  WallNodes(const Scene& scene, const Grid& grid) : scene_(scene), is_wall_(grid.size(), 0) {
    const int nx = grid.x.count(), ny = grid.y.count();
    const std::vector<double> length[2] = {grid.x.integrals(), grid.y.integrals()};
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const auto node = static_cast<std::size_t>(j * nx + i);
        const bool on_x = !grid.x.periodic && (i == 0 || i == nx - 1);
        const bool on_y = !grid.y.periodic && (j == 0 || j == ny - 1);
        if (!on_x && !on_y) continue;
        const Edge across_x = i == 0 ? Edge::Left : Edge::Right, across_y = j == 0 ? Edge::Bottom : Edge::Top;
        Node wall{node, on_x ? across_x : across_y, on_y ? across_y : across_x};
        if (!on_x) {
          wall.drag[0] = drag(scene.side(across_y), length[0][static_cast<std::size_t>(i)]);
          wall.pull[0] = scene.side(across_y).traction * length[0][static_cast<std::size_t>(i)];
        }
        if (!on_y) {
          wall.drag[1] = drag(scene.side(across_x), length[1][static_cast<std::size_t>(j)]);
          wall.pull[1] = scene.side(across_x).traction * length[1][static_cast<std::size_t>(j)];
        }
        slips_ |= wall.slips(0) || wall.slips(1);
        nodes_.push_back(wall);
      }
    }
    for (const Node& n : nodes_) is_wall_[n.index] = 1;
  }

  struct Node {
    std::size_t index;
    Edge x_from, y_from;  ///< the walls that give the x and y components; the same one but in corners
    /// Force of the wall by its velocity beyond the node's, along x and y [Pa s], per unit depth: mu/b of
    /// Navier's slip times the node's part of the wall. Infinite where the wall prescribes the component.
    std::array<double, 2> drag{std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::infinity()};

    std::array<double, 2> pull{0, 0};  ///< force of a traction along x, y per unit depth [N/m]

    [[nodiscard]] bool slips(std::size_t axis) const { return std::isfinite(drag[axis]); }
  };
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

  [[nodiscard]] bool is_wall(std::size_t node) const { return is_wall_[node] != 0; }

  /// Sets the wall's velocity at time t on its nodes.
  void impose_velocity(VectorField& velocity, double t) const {
    impose(velocity, [&](const Node& n) { return velocity_of(n, t); });
  }

  /// Sets the wall's prescribed acceleration dV/dt on its nodes (not the difference to the mapped velocity,
  /// which drops the particles to order 1.5).
  void impose_acceleration(VectorField& acceleration, double t) const {
    impose(acceleration, [&](const Node& n) { return acceleration_of(n, t); });
  }

  /// Sets the wall's mean acceleration (V(t + dt) - V(t))/dt, which brings its nodes to V(t + dt) exactly.
  void impose_mean_acceleration(VectorField& acceleration, double t, double dt) const {
    impose(acceleration,
           [&](const Node& n) -> Vec2 { return (velocity_of(n, t + dt) - velocity_of(n, t)) / dt; });
  }

  /// Adds to the nodal acceleration what walls that let the fluid slip do to it over dt: the pull of a
  /// traction, and drag, by backward Euler: the drag on a node of little mass would be stiff.
  void add_drag(Grid& grid, double t, double dt) const {
    if (!slips_) return;
    for (const Node& n : nodes_)
      for (std::size_t c : {0, 1}) {
        if (!n.slips(c) || !(grid.mass[n.index] > 0)) continue;
        const auto axis = static_cast<Eigen::Index>(c);
        double& a = grid.acceleration[n.index][axis];
        a += n.pull[c] / grid.mass[n.index];
        const double v = grid.velocity[n.index][axis] + dt * a;
        a += slip_change(v, velocity_of(n, t + dt)[axis], dt * n.drag[c] / grid.mass[n.index]) / dt;
      }
  }
  /// By how much a velocity changes that a wall drags towards its own, rate times the step being `drag` [-].
  static double slip_change(double v, double of_wall, double drag) {
    return drag / (1 + drag) * (of_wall - v);
  }

  /// Force that the walls exert on the fluid per unit depth [N/m] when nodes with lumped mass are given an
  /// acceleration that the other forces do not explain.
  [[nodiscard]] Vec2 reaction(const Grid& grid) const {
    Vec2 sum = Vec2::Zero();
    for (const Node& n : nodes_) sum += grid.mass[n.index] * grid.acceleration[n.index] - grid.force[n.index];
    return sum;
  }

  /// An impulsive start: by how much wall nodes jump from the initial field to the wall's velocity at
  /// that time.
  [[nodiscard]] VectorField initial_jump(const Grid& grid) const {
    VectorField jump(grid.size(), Vec2::Zero());
    for (const Node& n : nodes_) {
      const Vec2 fluid =
          scene_.initial_velocity ? scene_.initial_velocity(grid.control_point(n.index)) : Vec2(Vec2::Zero());
      const Vec2 change = velocity_of(n, scene_.start) - fluid;
      for (std::size_t c : {0, 1})
        if (!n.slips(c)) jump[n.index][static_cast<Eigen::Index>(c)] = change[static_cast<Eigen::Index>(c)];
    }
    return jump;
  }

 private:
  /// mu/b times a length of the wall; scenes with another fluid have walls that stick or slip freely.
  [[nodiscard]] double drag(const Side& side, double length) const {
    if (side.slip_length == 0) return std::numeric_limits<double>::infinity();
    const auto* fluid = std::get_if<Newtonian>(&scene_.fluid.rheology);
    return fluid ? fluid->viscosity() * length / side.slip_length : 0;
  }

  template <class Value>
  void impose(VectorField& field, const Value& value) const {
    if (!slips_) {
      for (const Node& n : nodes_) field[n.index] = value(n);
      return;
    }
    for (const Node& n : nodes_) {
      const Vec2 prescribed = value(n);
      for (std::size_t c : {0, 1})
        if (!n.slips(c))
          field[n.index][static_cast<Eigen::Index>(c)] = prescribed[static_cast<Eigen::Index>(c)];
    }
  }

  [[nodiscard]] Vec2 velocity_of(const Node& n, double t) const {
    return {scene_.side(n.x_from).velocity(t).x(), scene_.side(n.y_from).velocity(t).y()};
  }
  [[nodiscard]] Vec2 acceleration_of(const Node& n, double t) const {
    return {scene_.side(n.x_from).acceleration(t).x(), scene_.side(n.y_from).acceleration(t).y()};
  }

  const Scene& scene_;
  std::vector<Node> nodes_;
  std::vector<char> is_wall_;
  bool slips_ = false;  // somewhere
};

}  // namespace mpm
