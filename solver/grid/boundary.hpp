#pragma once

#include <vector>

#include "solver/grid/grid.hpp"
#include "solver/scene/scene.hpp"

namespace mpm {

/// What a mass matrix is solved for: an iteration starts from the last solution of the same kind.
enum class Nodal { Velocity, Acceleration };

/// The nodes whose functions do not vanish on a wall: the first and the last along a direction with walls,
/// for every basis here. Their values are the field's values on the wall, so the wall prescribes them. In
/// a corner each wall prescribes the velocity normal to it, so that nothing is pushed through either (a lid
/// does not drag the corner through the wall beside it).
class WallNodes {
 public:
  WallNodes(const Scene& scene, const Grid& grid) : scene_(scene), is_wall_(grid.size(), 0) {
    const int nx = grid.x.count(), ny = grid.y.count();
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const auto node = static_cast<std::size_t>(j * nx + i);
        const bool on_x = !grid.x.periodic && (i == 0 || i == nx - 1);
        const bool on_y = !grid.y.periodic && (j == 0 || j == ny - 1);
        if (!on_x && !on_y) continue;
        const Edge across_x = i == 0 ? Edge::Left : Edge::Right, across_y = j == 0 ? Edge::Bottom : Edge::Top;
        nodes_.push_back({node, on_x ? across_x : across_y, on_y ? across_y : across_x});
      }
    }
    for (const Node& n : nodes_) is_wall_[n.index] = 1;
  }

  struct Node {
    std::size_t index;
    Edge x_from, y_from;  ///< the walls that give the x and y components; the same one but in corners
  };
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

  [[nodiscard]] bool is_wall(std::size_t node) const { return is_wall_[node] != 0; }

  /// Sets the wall's velocity at time t on its nodes.
  void impose_velocity(VectorField& velocity, double t) const {
    for (const Node& n : nodes_) velocity[n.index] = velocity_of(n, t);
  }

  /// Sets the wall's prescribed acceleration dV/dt on its nodes (not the difference to the mapped velocity,
  /// which drops the particles to order 1.5).
  void impose_acceleration(VectorField& acceleration, double t) const {
    for (const Node& n : nodes_) acceleration[n.index] = acceleration_of(n, t);
  }

  /// Sets the wall's mean acceleration (V(t + dt) - V(t))/dt, which brings its nodes to V(t + dt) exactly.
  void impose_mean_acceleration(VectorField& acceleration, double t, double dt) const {
    for (const Node& n : nodes_) acceleration[n.index] = (velocity_of(n, t + dt) - velocity_of(n, t)) / dt;
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
      jump[n.index] = velocity_of(n, scene_.start) - fluid;
    }
    return jump;
  }

 private:
  [[nodiscard]] Vec2 velocity_of(const Node& n, double t) const {
    return {scene_.side(n.x_from).velocity(t).x(), scene_.side(n.y_from).velocity(t).y()};
  }
  [[nodiscard]] Vec2 acceleration_of(const Node& n, double t) const {
    return {scene_.side(n.x_from).acceleration(t).x(), scene_.side(n.y_from).acceleration(t).y()};
  }

  const Scene& scene_;
  std::vector<Node> nodes_;
  std::vector<char> is_wall_;
};

}  // namespace mpm
