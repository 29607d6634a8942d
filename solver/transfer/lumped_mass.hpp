#pragma once

#include "solver/grid/boundary.hpp"
#include "solver/grid/matrices/sparse_pattern.hpp"
#include "solver/grid/stencil_table.hpp"

namespace mpm {

/// Nodal mass summed onto the diagonal, m_i = sum_p N_ip m_p: each node for itself.
class LumpedMass {
 public:
  LumpedMass(const Grid&, const WallNodes&) {}

  /// Nothing to do: grid.mass is summed with the momenta.
  template <class Basis>
  void assemble(const StencilTable&, const Grid&, const Particles&) {}
  [[nodiscard]] static constexpr bool needs_table() { return false; }

  /// field_i /= m_i, in place; a node without mass gets zero. `impose` sets the walls' values.
  template <class Impose>
  void solve(const Grid& grid, VectorField& field, Impose&& impose, Nodal = Nodal::Velocity) const {
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (grid.mass[i] > 0)
        field[i] /= grid.mass[i];
      else
        field[i] = Vec2::Zero();
    }
    impose(field);
  }

  /// What the grid sees of a nodal increment once particles have added it to their own velocity: with lumped
  /// mass P2G after G2P is a smoothing, and a stage that left it out would be first order in time.
  template <class Basis>
  void remap(const Grid& grid, const Particles& particles, VectorField& field) const {
    VectorField sum(field.size(), Vec2::Zero());
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Stencil<Basis> stencil(grid, particles.position[p]);
      Vec2 share = Vec2::Zero();
      stencil.values([&](std::size_t i, double n) { share += n * field[i]; });
      share *= particles.mass[p];
      stencil.values([&](std::size_t i, double n) { sum[i] += n * share; });
    }
    solve(grid, sum, [](VectorField&) {});
    field.swap(sum);
  }

  /// Force of the walls on the fluid per unit depth [N/m].
  [[nodiscard]] Vec2 wall_force(const Grid& grid, const WallNodes& walls) const {
    return walls.reaction(grid);
  }

  /// The masses as a diagonal matrix.
  [[nodiscard]] SparseMatrix matrix(const Grid& grid) const {
    const auto n = static_cast<Eigen::Index>(grid.size());
    SparseMatrix diagonal(n, n);
    diagonal.setIdentity();
    for (Eigen::Index i = 0; i < n; ++i) diagonal.coeffRef(i, i) = grid.mass[static_cast<std::size_t>(i)];
    return diagonal;
  }
};

}  // namespace mpm
