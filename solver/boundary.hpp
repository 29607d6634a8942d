#pragma once

#include <vector>

#include "solver/basis.hpp"
#include "solver/grid.hpp"
#include "solver/particles.hpp"
#include "solver/scene.hpp"

namespace mpm {

/// The nodes that lie on walls. Where two walls meet the node belongs to the bottom or top wall.
class WallNodes {
 public:
  WallNodes(const Scene& scene, const Grid& grid) : scene_(scene) {
    const int nx = grid.x.count(), ny = grid.y.count();
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const auto node = static_cast<std::size_t>(j * nx + i);
        if (!grid.y.periodic && (j == 0 || j == ny - 1))
          nodes_.push_back({node, j == 0 ? Edge::Bottom : Edge::Top, i, j});
        else if (!grid.x.periodic && (i == 0 || i == nx - 1))
          nodes_.push_back({node, i == 0 ? Edge::Left : Edge::Right, i, j});
      }
    }
  }

  /// Sets the wall's velocity at time t on its nodes.
  void impose_velocity(VectorField& velocity, double t) const {
    for (const Node& n : nodes_) velocity[n.index] = scene_.side(n.edge).velocity(t);
  }

  /// Gives the nodes the wall's prescribed acceleration dV/dt (not the difference to the mapped velocity,
  /// which drops the particles to order 1.5) and returns the force that the walls exert on the fluid per unit
  /// depth [N/m].
  Vec2 impose_acceleration(Grid& grid, double t) const {
    Vec2 reaction = Vec2::Zero();
    for (const Node& n : nodes_) {
      grid.acceleration[n.index] = scene_.side(n.edge).acceleration(t);
      reaction += grid.mass[n.index] * grid.acceleration[n.index] - grid.force[n.index];
    }
    return reaction;
  }

  /// An impulsive start: wall nodes jump from the initial field to the wall's velocity at t = 0, and the
  /// particles take their share of that jump, as FLIP hands them every later change of a node.
  template <class Basis>
  void start_impulsively(const Grid& grid, Particles& particles) const {
    if (nodes_.empty()) return;
    VectorField jump(grid.size(), Vec2::Zero());
    for (const Node& n : nodes_) {
      const Vec2 point(n.i == 0                                        ? 0
                       : n.i == grid.x.count() - 1 && !grid.x.periodic ? grid.x.length
                                                                       : n.i * grid.x.h,
                       n.j == 0                                        ? 0
                       : n.j == grid.y.count() - 1 && !grid.y.periodic ? grid.y.length
                                                                       : n.j * grid.y.h);
      const Vec2 fluid = scene_.initial_velocity ? scene_.initial_velocity(point) : Vec2(Vec2::Zero());
      jump[n.index] = scene_.side(n.edge).velocity(0) - fluid;
    }
    for (std::size_t p = 0; p < particles.size(); ++p)
      particles.velocity[p] += interpolate<Basis>(grid, jump, particles.position[p]);
  }

 private:
  struct Node {
    std::size_t index;
    Edge edge;
    int i, j;
  };
  const Scene& scene_;
  std::vector<Node> nodes_;
};

}  // namespace mpm
