#pragma once

#include <memory>

#include "solver/grid/boundary.hpp"
#include "solver/grid/matrices/sparse_pattern.hpp"
#include "solver/grid/stencil_table.hpp"
#include "solver/material/rheology.hpp"

namespace mpm {

struct ImplicitSolution {
  Vec2 wall_impulse;  ///< that holds the wall nodes at their velocity, per unit depth [kg/s]
  bool converged;
};

/// Backward Euler for the viscous stress: the nonlinear system M (v - start) = dt (f + f_visc(v)).
class ImplicitViscosity {
 public:
  virtual ~ImplicitViscosity() = default;

  /// Solves for v, from the value that it has: wall nodes keep it, nodes without mass get zero.
  /// `table` holds the particles' stencils, `mass` is the nodal mass matrix, `start` a velocity [m/s],
  /// `force` the other forces per unit depth [N/m], dt in [s].
  virtual ImplicitSolution solve(const StencilTable& table, const Particles& particles,
                                 const SparseMatrix& mass, const VectorField& start, const VectorField& force,
                                 double dt, VectorField& velocity) = 0;
};

std::unique_ptr<ImplicitViscosity> make_implicit_viscosity(const Rheology& rheology, const Grid& grid,
                                                           const WallNodes& walls);

}  // namespace mpm
