#pragma once

#include "solver/scene/scene.hpp"
#include "verification/flows/flow.hpp"

namespace verification {

/// A scene whose solution varies across it alone: `thickness` [m] in d.cells cells, d.cells_along cells of
/// the same size along `along` (0: x, 1: y), periodic, without a fluid yet.
inline mpm::Scene layer(double thickness, int along, const Discretisation& d) {
  const int across = 1 - along;
  mpm::Scene scene;
  scene.size[across] = thickness;
  scene.size[along] = thickness / d.cells * d.cells_along;
  scene.cells[static_cast<std::size_t>(across)] = d.cells;
  scene.cells[static_cast<std::size_t>(along)] = d.cells_along;
  scene.particles_per_cell[static_cast<std::size_t>(across)] = d.particles_across;
  scene.particles_per_cell[static_cast<std::size_t>(along)] = d.particles_along;
  return scene;
}

/// The side of a layer at coordinate zero across it, and the one opposite.
inline mpm::Edge first_edge(int across) {
  return across == 1 ? mpm::Edge::Bottom : mpm::Edge::Left;
}
inline mpm::Edge last_edge(int across) {
  return across == 1 ? mpm::Edge::Top : mpm::Edge::Right;
}

}  // namespace verification
