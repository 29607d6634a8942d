#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "solver/kernel/threads/thread_team.hpp"

namespace mpm {

// The interface to the vector kernels of the incompressible method: plain data, so that what is compiled for
// one instruction set (solver/kernel/isa.hpp) shares no function with what is compiled for another. Points
// and velocities are pairs (x, y), one after another; "less" is 0 for functions of degree k, 1 for k - 1.

/// Cholesky's factor L of a matrix along a line: beside the diagonal, the entries of its rows and of its
/// columns.
struct LineFactor {
  struct Entries {
    std::vector<int> begin;  ///< of a row's (or column's) entries
    std::vector<int> other;  ///< column (or row) of each
    std::vector<double> value;
  };
  std::vector<double> inverse_diagonal;
  Entries rows, columns;
};

/// One direction of the grid, with its functions of degree k and k - 1.
struct LineOfFunctions {
  int cells;
  bool periodic;
  double length;                               ///< [m]
  std::array<const double*, 2> polynomials;    ///< SplineAxis::polynomials of all cells, by less
  std::array<std::vector<double>, 2> mass;     ///< entry (i, i + d) at d * functions + i, d = 0 .. degree [m]
  std::array<int, 2> unknowns, first_unknown;  ///< how many functions are unknowns, and the first of them
  std::array<LineFactor, 2> factor;            ///< of the mass over the unknowns
};

/// Outlives the kernels that are made from it.
struct PlaneSetup {
  int degree;
  std::array<LineOfFunctions, 2> axis;
  double regularisation;  ///< share of the exact mass that the fit adds
};

/// The particles' loops of the incompressible method and the fit of a field to them.
class PlaneKernel {
 public:
  virtual ~PlaneKernel() = default;

  /// The field that velocities() and drift() follow, by its unknowns [m/s].
  virtual void follow(const double* unknowns) = 0;
  /// Velocities at places inside the domain [m/s].
  virtual void velocities(const double* places, std::size_t count, double* velocities) const = 0;
  /// Moves points along the field, which stands still, for dt [s] by the midpoint rule: around periodic
  /// directions, and not beyond walls, to which the field is tangential.
  virtual void drift(const double* from, std::size_t count, double dt, double* to) const = 0;

  /// Takes particles of volumes [m2] at places [m] with velocities [m/s]: the matrix and loads of the fit.
  /// Sums run cell by cell, in each by the particles' numbers: the same for any number of threads.
  virtual void assemble(const double* volumes, const double* places, const double* velocities,
                        std::size_t count, ThreadTeam& team) = 0;
  /// Solves the fit for one component by conjugate gradients from `last` on, to which it is held where
  /// particles are few, until the error has fallen to `tolerance` in the norm of the preconditioner. Both are
  /// that component's unknowns.
  virtual void solve(int component, double tolerance, const double* last, double* result) const = 0;
  /// Fewest and most particles of a cell where they were taken last.
  [[nodiscard]] virtual std::pair<int, int> occupancy() const = 0;
};

}  // namespace mpm
