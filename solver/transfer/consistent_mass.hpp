#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <optional>

#include "solver/grid/boundary.hpp"
#include "solver/grid/matrices/banded_matrix.hpp"
#include "solver/grid/matrices/sparse_pattern.hpp"
#include "solver/grid/matrices/stencil_matrix.hpp"
#include "solver/grid/matrices/tensor_mass.hpp"
#include "solver/grid/stencil_table.hpp"

namespace mpm {

/// The consistent mass matrix M_ij = sum_p m_p N_ip N_jp with prescribed values on wall nodes. On a strip
/// (one function wide in one direction) it is banded and factorised directly, elsewhere conjugate gradients
/// solve it, preconditioned with the matrix of a uniform fluid. Functions that hold next to no mass are left
/// out and their values are zero, so that empty cells do no harm.
class ConsistentMass {
 public:
  ConsistentMass(const Grid& grid, const WallNodes& walls);
  /// Without prescribed values.
  explicit ConsistentMass(const Grid& grid);

  /// Whether assemble() reads the table.
  [[nodiscard]] bool needs_table() const { return direct_.has_value(); }

  /// Sums the matrix.
  template <class Basis>
  void assemble(const StencilTable& table, const Grid& grid, const Particles& particles) {
    if (direct_) return assemble_direct(table, grid, particles);
    iterative_->matrix.assemble<Basis>(grid, particles);
    fix_nodes();
  }

  /// field <- M^-1 field, in place, with the values that `impose` sets on the wall nodes. Without walls the
  /// total of the field, its momentum or force, is kept to round-off, whatever the iteration leaves.
  template <class Impose>
  void solve(const Grid& grid, VectorField& field, Impose&& impose, Nodal kind = Nodal::Velocity) {
    VectorField& guess = guess_[static_cast<std::size_t>(kind)];
    if (guess.empty()) {
      guess.assign(grid.size(), Vec2::Zero());
      for (std::size_t i = 0; i < grid.size(); ++i)
        if (grid.mass[i] > 0) guess[i] = field[i] / grid.mass[i];
    }
    impose(guess);
    solve_from(guess, field, grid.mass);
    guess = field;
  }

  /// Force of the walls on the fluid per unit depth [N/m]: what the momentum balance of the whole fluid
  /// lacks.
  [[nodiscard]] Vec2 wall_force(const Grid& grid, const WallNodes&) const {
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i < grid.size(); ++i) sum += grid.mass[i] * grid.acceleration[i] - grid.force[i];
    return sum;
  }

  /// M, both triangles.
  [[nodiscard]] const SparseMatrix& matrix(const Grid& grid);

 private:
  /// A strip's matrix, factorised.
  struct Direct {
    explicit Direct(const Grid& grid);
    void assemble(const StencilTable& table, const ScalarField& particle_mass);
    /// Factorises the constrained matrix; false where it is singular but for round-off.
    [[nodiscard]] bool factorise();
    void solve(VectorField& field) const;

    SparseMatrix matrix, constrained;
    PairSlots slots;
    // Between walls a band of both components in turn; general where the strip closes.
    std::optional<BandedMatrix> band;
    Eigen::SimplicialLDLT<SparseMatrix> factor;
    bool holds = false;
  };
  /// A plane's matrix, and what it is preconditioned with.
  struct Iterative {
    explicit Iterative(const Grid& grid) : matrix(grid), uniform(grid), scale(grid.size()) {}
    StencilMatrix matrix;
    TensorMass uniform;
    ScalarField scale;  ///< (T_ii/M_ii)^1/2 [m/kg^1/2]; 0 on nodes that are fixed
  };

  /// Sums and factorises, unless the particles stand across the strip as they last did.
  void assemble_direct(const StencilTable& table, const Grid& grid, const Particles& particles);
  void fix_nodes();
  void solve_from(VectorField& guess, VectorField& field, const ScalarField& nodal_mass);
  void solve_direct(VectorField& guess, VectorField& field);
  void iterate(const VectorField& guess, VectorField& field);
  void keep_total(const Vec2& total, const ScalarField& nodal_mass, VectorField& field) const;

  std::vector<char> is_wall_, is_fixed_;  // fixed: on a wall or without mass
  bool has_walls_ = false;
  std::optional<Direct> direct_;
  std::optional<Iterative> iterative_;
  double largest_ = 0;          // diagonal entry
  Remembered across_, masses_;  // of the particles whose matrix stands assembled
  std::array<VectorField, 2> guess_;
  VectorField fixed_;  // prescribed values; zero elsewhere
  SparseMatrix written_out_;
};

}  // namespace mpm
