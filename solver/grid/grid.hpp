#pragma once

#include <vector>

#include "solver/grid/axis.hpp"
#include "solver/linear_algebra.hpp"
#include "solver/scene/scene.hpp"

namespace mpm {

/// Nodal fields on the background grid. Index of a node: j * x.count() + i.
struct Grid {
  Grid(const Scene& scene, int degree)
      : x(scene.size.x(), scene.cells[0], scene.periodic(0), degree),
        y(scene.size.y(), scene.cells[1], scene.periodic(1), degree) {
    const auto n = static_cast<std::size_t>(x.count()) * static_cast<std::size_t>(y.count());
    mass.assign(n, 0);
    velocity.assign(n, Vec2::Zero());
    force.assign(n, Vec2::Zero());
    acceleration.assign(n, Vec2::Zero());
    mapped.assign(n, Vec2::Zero());
  }

  [[nodiscard]] std::size_t size() const { return mass.size(); }
  /// Where a linear field is sampled for its control value at a node: the node itself for the linear basis
  /// [m].
  [[nodiscard]] Vec2 control_point(std::size_t node) const {
    const int i = static_cast<int>(node) % x.count(), j = static_cast<int>(node) / x.count();
    return {x.control_point(i), y.control_point(j)};
  }

  Axis x, y;
  ScalarField mass;          ///< m_i [kg/m]
  VectorField velocity;      ///< v_i: momentum while it is being summed, then velocity [m/s]
  VectorField force;         ///< f_i: internal and body force per unit depth [N/m]
  VectorField acceleration;  ///< a_i [m/s2]
  VectorField mapped;        ///< velocity of the updated particles mapped back (MUSL) [m/s]
};

}  // namespace mpm
