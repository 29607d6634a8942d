#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "solver/grid/boundary.hpp"
#include "solver/lanes/lane_layout.hpp"

namespace mpm {

/// What the walls of a scene do to the nodes of the kernel, part by part of a sweep, and the momentum that
/// they give the fluid by it.
class LaneWalls {
 public:
  /// Of every wall, by component of the kernel.
  using Values = std::array<std::array<double, 2>, 4>;

  LaneWalls(const Scene& scene, const Grid& grid, const WallNodes& walls, const LaneLayout& layout,
            int shares)
      : scene_(scene), layout_(layout), impulse_(static_cast<std::size_t>(shares)) {
    std::vector<const WallNodes::Node*> wall_of(grid.size(), nullptr);
    for (const WallNodes::Node& wall : walls.nodes()) wall_of[wall.index] = &wall;
    for (int l = 0; l < layout.rows(); ++l) {
      first_of_row_.push_back(nodes_.size());
      for (int k = 0; k < layout.stride(); ++k) {
        const int i = layout.axis(0).function(k), j = layout.axis(1).function(l);
        const WallNodes::Node* wall = wall_of[layout.grid_index(i, j)];
        if (!wall) continue;
        const std::size_t from[2] = {static_cast<std::size_t>(wall->x_from),
                                     static_cast<std::size_t>(wall->y_from)};
        const auto along = static_cast<std::size_t>(layout.axis_of(0)), across = 1 - along;
        nodes_.push_back({layout.node(k, l),
                          k != i || l != j,
                          {from[along], from[across]},
                          {wall->drag[along], wall->drag[across]},
                          {wall->pull[along], wall->pull[across]},
                          wall->slips(0) || wall->slips(1)});
      }
    }
    first_of_row_.push_back(nodes_.size());
  }

  [[nodiscard]] Values velocity(double t) const { return values(t, &Side::velocity); }
  [[nodiscard]] Values acceleration(double t) const { return values(t, &Side::acceleration); }

  /// Gives wall nodes the walls' velocity.
  void impose_velocity(const Part& part, const Values& wall, double* const velocity[2]) const {
    for (const Node& node : rows(part.complete))
      for (int c : {0, 1})
        if (node.prescribes(c)) velocity[c][node.index] = wall[node.from[c]][static_cast<std::size_t>(c)];
  }

  /// The same; of the momentum that this adds, particles take a part: an impulse.
  void impose_velocity(const Part& part, const Values& wall, const NodeFields& fields, double part_taken) {
    Impulse& impulse = impulse_[static_cast<std::size_t>(part.share)];
    if (part_taken > 0)
      for (const Node& node : rows(part.complete))
        for (int c : {0, 1})
          if (node.prescribes(c))
            impulse.of[c] +=
                part_taken * counted_mass(node, fields) *
                (wall[node.from[c]][static_cast<std::size_t>(c)] - fields.velocity[c][node.index]);
    impose_velocity(part, wall, fields.velocity);
  }

  /// Gives wall nodes the walls' acceleration over dt in place of the one that they had.
  void impose_acceleration(const Part& part, const Values& wall, const NodeFields& fields, double dt) {
    Impulse& impulse = impulse_[static_cast<std::size_t>(part.share)];
    for (const Node& node : rows(part.complete)) {
      const double mass = counted_mass(node, fields);
      for (int c : {0, 1}) {
        if (!node.prescribes(c)) continue;
        double& a = fields.acceleration[c][node.index];
        const double of_wall = wall[node.from[c]][static_cast<std::size_t>(c)];
        const double change = dt * (of_wall - a);
        a = of_wall;
        fields.velocity[c][node.index] += change;
        impulse.of[c] += mass * change;
      }
    }
  }

  /// Gives nodes of walls that let the fluid slip what the wall's drag makes of them over dt; after
  /// impose_acceleration().
  void add_drag(const Part& part, const Values& wall_at_end, const NodeFields& fields, double dt) {
    Impulse& impulse = impulse_[static_cast<std::size_t>(part.share)];
    for (const Node& node : rows(part.complete))
      for (int c : {0, 1}) {
        if (node.prescribes(c)) continue;
        double& v = fields.velocity[c][node.index];
        const double pulled = dt * node.pull[c] * fields.inverse_mass[node.index];
        const double change = pulled + WallNodes::slip_change(
                                           v + pulled, wall_at_end[node.from[c]][static_cast<std::size_t>(c)],
                                           dt * node.drag[c] * fields.inverse_mass[node.index]);
        v += change;
        fields.acceleration[c][node.index] += change / dt;
        impulse.of[c] += counted_mass(node, fields) * change;
      }
  }

  /// Whether some wall lets the fluid slip.
  [[nodiscard]] bool slip() const {
    return std::any_of(nodes_.begin(), nodes_.end(), [](const Node& node) { return node.slips; });
  }

  /// What the walls have given since this was asked last [kg/s], in the order of shares whoever worked on
  /// them.
  Vec2 take_impulse() {
    Vec2 sum = Vec2::Zero();
    for (Impulse& impulse : impulse_) {
      for (int c : {0, 1}) sum[layout_.axis_of(c)] += impulse.of[c];
      impulse = {};
    }
    return sum;
  }

 private:
  struct Node {
    int index;            ///< in the kernel
    bool is_image;        ///< of a periodic node that stands in the list, too
    std::size_t from[2];  ///< the sides that give its two components
    double drag[2];       ///< WallNodes::Node
    double pull[2];       ///< the same
    bool slips;           ///< along one of them

    [[nodiscard]] bool prescribes(int c) const { return !slips || !std::isfinite(drag[c]); }
  };
  /// By component of the kernel, on a cache line of its own.
  struct alignas(64) Impulse {
    double of[2] = {0, 0};
  };

  [[nodiscard]] std::span<const Node> rows(Rows rows) const {
    const auto at = [&](int row) { return nodes_.data() + first_of_row_[static_cast<std::size_t>(row)]; };
    return {at(rows.begin), at(rows.end)};
  }

  /// Mass of a node in sums over all nodes: none, when an image of it is counted already.
  static double counted_mass(const Node& node, const NodeFields& fields) {
    const double inverse = fields.inverse_mass[node.index];
    return inverse > 0 && !node.is_image ? 1 / inverse : 0;
  }

  [[nodiscard]] Values values(double t, std::function<Vec2(double)> Side::*quantity) const {
    Values values{};
    for (std::size_t edge = 0; edge < 4; ++edge) {
      const Side& side = scene_.sides[edge];
      if (side.periodic) continue;
      const Vec2 value = (side.*quantity)(t);
      for (int c : {0, 1}) values[edge][static_cast<std::size_t>(c)] = value[layout_.axis_of(c)];
    }
    return values;
  }

  const Scene& scene_;
  const LaneLayout& layout_;
  std::vector<Node> nodes_;  // row by row
  std::vector<std::size_t> first_of_row_;
  std::vector<Impulse> impulse_;  // by share
};

}  // namespace mpm
