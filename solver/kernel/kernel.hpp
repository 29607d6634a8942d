#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "solver/material/pressure.hpp"
#include "solver/material/rheology.hpp"

namespace mpm {

// The interface between a solver and the vector kernels. Plain data only: the kernels are compiled for other
// instruction sets than the rest, and nothing that both compile may differ between them. Components: 0 along
// the lanes of a vector, 1 across them; which of them is x is the solver's business.

/// One material point. Per unit depth, SI units.
struct PointState {
  double position[2], velocity[2];
  double mass, density;
  double stress[3];     ///< sigma_00, sigma_11, sigma_01
  double affine[2][2];  ///< C_ab of its affine field, APIC alone [1/s]
};

/// One direction of the grid: Axis as plain data.
struct LineOfCells {
  int cells;
  bool periodic;
  double length, inverse_h;
  /// Of every cell, one after another: Axis::polynomials, then Axis::control_place of its functions.
  const double* functions;
};

/// Nodal fields. Nodes are numbered n = row * stride + i with i counted along the axis (Axis::function), so
/// that images of a periodic node have entries of their own, all of the same value.
struct NodeFields {
  double* inverse_mass;     ///< 1/m_i [m/kg], 0 where there is no mass
  double* velocity[2];      ///< v_i [m/s]
  double* mapped[2];        ///< velocity of the updated particles mapped back (MUSL) [m/s]
  double* acceleration[2];  ///< a_i [m/s2]
};

/// Rows [begin, end) of cells or of nodes.
struct Rows {
  int begin = 0, end = 0;
};

/// What a pass does at a time. Cells are visited in whole vectors, each with the row in which it begins: its
/// last cells may lie in the next one.
struct Part {
  Rows fresh;     ///< nodes to which nothing has been added
  Rows cells;     ///< whose particles are visited
  Rows complete;  ///< nodes to which nothing more will be added
  int share = 0;  ///< sums that are kept between parts: one a share, so that threads need not agree
  int ahead = 0;  ///< particles that lie so many cells on are fetched from memory meanwhile
};

/// What the particles' move found.
struct Motion {
  /// Sum of v^2 [m2/s2]: not finite when a velocity is not, or is so large that its square is not.
  double energy = 0;
  bool inside = true, dense = true;
};

enum class NodalVelocity { Current, Mapped };

/// Particles in the order of their cells, `width` neighbouring cells a vector, and the passes over them. One
/// pass is one loop; what belongs together for speed is one pass.
class Kernel {
 public:
  virtual ~Kernel() = default;

  virtual NodeFields nodes() = 0;

  /// P2G: nodal mass and the velocity that momentum over mass makes; walls are not imposed.
  virtual void map_velocity(const Part&) = 0;
  /// P2G of updated particles that have not moved yet, to NodalVelocity::Mapped; walls are not imposed.
  virtual void map_updated_velocity(const Part&) = 0;
  /// Density over dt and stress from a nodal velocity; dt = 0 sets the stress of the present state.
  virtual void update_stress(const Part&, NodalVelocity from, double dt) = 0;
  /// a_i = f_i/m_i + b of the stress that the particles have, v_i += dt a_i; walls are not imposed.
  virtual void accelerate(const Part&, const double body_acceleration[2], double dt) = 0;
  /// update_stress() from the current velocity and accelerate() in one; the stress is not kept.
  virtual void update_stress_and_accelerate(const Part&, const double body_acceleration[2], double dt) = 0;
  /// G2P: FLIP, PIC or a mean of the two: v_p = flip (v_p + dt a(x_p)) + (1 - flip) v(x_p). Particles that
  /// carry an affine field take v(x_p) and C_p, whatever the fraction.
  virtual void take(const Part&, double flip_fraction, double dt) = 0;
  /// Moves the particles with the nodal velocity.
  virtual void move(const Part&, double dt) = 0;
  /// take() and move().
  virtual void take_and_move(const Part&, double flip_fraction, double dt) = 0;
  /// When all have moved: gives those that left their cells new places.
  virtual Motion settle() = 0;

  /// Writes all particles in the order in which they came.
  virtual void gather(PointState* points) const = 0;
};

struct KernelSetup {
  int degree;  ///< of the basis, 1 to 3
  bool strip;  ///< one periodic cell across the lanes, in which nothing varies
  std::array<LineOfCells, 2> axis;
  Rheology rheology;
  bool is_affine;     ///< particles carry an affine field (APIC)
  bool keeps_stress;  ///< from one step to the next
  bool has_pressure;
  bool has_cell_pressure;  ///< one density a cell
  CellTaitPressure pressure;
  double most_inverse_mass;  ///< 1/m_i with which a node feels the stress at most [m/kg]
  const PointState* points;
  std::size_t count;
  int shares;  ///< Part::share is below it
};

}  // namespace mpm
