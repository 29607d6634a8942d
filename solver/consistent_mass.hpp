#pragma once

#include <Eigen/SparseCholesky>

#include "solver/boundary.hpp"
#include "solver/sparse_pattern.hpp"
#include "solver/stencil_table.hpp"

namespace mpm {

/// The consistent mass matrix M_ij = sum_p m_p N_ip N_jp with prescribed values on wall nodes. On a strip
/// (one function wide in one direction) it is banded and factorised directly, elsewhere conjugate gradients
/// with the diagonal as preconditioner solve it. Functions that hold next to no mass are left out and their
/// values are zero, so that empty cells do no harm.
class ConsistentMass {
 public:
  static constexpr bool needs_table = true;

  ConsistentMass(const Grid& grid, const WallNodes& walls);

  /// Sums the matrix, and factorises it, unless the stencils are the last ones.
  void assemble(const StencilTable& table, const ScalarField& particle_mass);

  /// field <- M^-1 field, in place, with the values that `impose` sets on the wall nodes.
  template <class Impose>
  void solve(const Grid& grid, VectorField& field, Impose&& impose) const {
    VectorField guess(grid.size(), Vec2::Zero());
    for (std::size_t i = 0; i < grid.size(); ++i)
      if (grid.mass[i] > 0) guess[i] = field[i] / grid.mass[i];
    impose(guess);
    solve_from(guess, field);
  }

  /// Force of the walls on the fluid per unit depth [N/m]: what the momentum balance of the whole fluid
  /// lacks.
  [[nodiscard]] Vec2 wall_force(const Grid& grid, const WallNodes&) const {
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i < grid.size(); ++i) sum += grid.mass[i] * grid.acceleration[i] - grid.force[i];
    return sum;
  }

  /// M, both triangles.
  [[nodiscard]] const SparseMatrix& matrix(const Grid&) const { return matrix_; }

 private:
  void constrain();
  /// Solves for the nodes that are not fixed; walls take their values from the guess.
  void solve_from(VectorField& guess, VectorField& field) const;

  bool strip_, direct_holds_ = false;
  std::vector<char> is_wall_, is_fixed_;  // fixed: on a wall or without mass
  SparseMatrix matrix_, constrained_;
  PairSlots slots_;
  double largest_ = 0;  // diagonal entry
  StencilTable last_;   // whose matrix stands assembled
  Eigen::SimplicialLDLT<SparseMatrix> direct_;
};

}  // namespace mpm
