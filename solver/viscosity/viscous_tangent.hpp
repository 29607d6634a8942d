#pragma once

#include <memory>
#include <vector>

#include "solver/grid/matrices/sparse_pattern.hpp"
#include "solver/grid/stencil_table.hpp"

namespace mpm {

/// A particle's strain rate D [1/s] and, there, mu [Pa s] and d mu/d(gdot^2).
struct Linearised {
  Mat2 d;
  double mu, slope;
};

/// M + dt K: the mass matrix and the derivative of the viscous forces by the nodal velocities, symmetric: the
/// part that trace D makes unsymmetric is left out.
class ViscousTangent {
 public:
  virtual ~ViscousTangent() = default;

  /// Sums the matrix and factorises it with the fixed nodes left alone. `law` and `weight`, dt times the
  /// volume per unit depth [m2 s], have an entry a particle.
  virtual void factorise(const SparseMatrix& mass, const StencilTable& table,
                         const std::vector<Linearised>& law, const ScalarField& weight,
                         const std::vector<char>& fixed) = 0;
  /// field <- J^-1 field, J the matrix with the fixed nodes left alone.
  virtual void solve(VectorField& field) const = 0;
  /// field += a node's columns of the whole matrix times v.
  virtual void add_columns(std::size_t node, const Vec2& v, VectorField& field) const = 0;
  /// A node's rows of the whole matrix times a field.
  [[nodiscard]] virtual Vec2 row_times(std::size_t node, const VectorField& field) const = 0;
};

/// Banded between walls where stencils run along y alone (is_strip), sparse elsewhere.
std::unique_ptr<ViscousTangent> make_viscous_tangent(const Grid& grid, bool is_strip);

}  // namespace mpm
