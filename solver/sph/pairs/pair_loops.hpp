#pragma once

#include <cstddef>
#include <cstdint>

namespace mpm::sph {

// The interface between SPH and its vector loops over pairs, plain data alone: the loops are compiled once
// for every instruction set (solver/kernel/isa.hpp).
//
// Entries lie in rows along x, each in the order of x. A lane is a particle, those of a vector follow each
// other in their row, and meet a window of another row together: the first of them its first entry, the next
// one the entry after that, and so on, all a step further each time. On a lattice, sheared or not, that is
// all of their neighbours and little else. Entries beyond the kernel's reach add nothing, as its table is
// zero.

/// Lanes of a vector at most: rows of entries begin and end with as many empty slots.
inline constexpr std::uint32_t most_lanes = 8;

/// What pairs read of the entries, an array each over their slots. Empty slots have zeros.
template <class Array>
struct EntryFields {
  Array position[2];      ///< [m]
  Array velocity[2];      ///< [m/s]
  Array mass;             ///< [kg/m]
  Array pressure_term;    ///< P/rho^2 [Pa m6/kg2]
  Array inverse_density;  ///< [m3/kg]
  Array viscosity;        ///< dynamic [Pa s]
  Array stress[4];        ///< mu L, row by row [Pa]
  Array wall_normal[2];   ///< of a fixed wall particle's wall, inwards
  Array wall_offset;      ///< x is normal.x + offset from its plane [m]
  Array wall_depth;       ///< how far behind its wall a fixed particle lies [m]
};

/// Lane l meets the entries first + l to first + l + count - 1.
struct Window {
  std::uint32_t first, count;
};

/// Particles in one vector: those in the slots from `slot` on. Windows [begin, walls) hold the fluid and its
/// copies, [walls, end) what belongs to walls.
struct Group {
  std::uint32_t slot, count;
  std::uint32_t begin, walls, end;
  std::size_t first_slope;
};

/// A function of r^2, see RadialTable.
struct RadialPoints {
  double scale, intervals;
  const double* points;  ///< value and difference to the next, one after the other
};

/// What the loops read and write. Sums over pairs have a place for every lane of every group.
struct PairWork {
  EntryFields<const double*> entries;
  const Group* groups;
  const Window* windows;
  RadialPoints weight, gradient;
  double* slope;                 ///< F of all pairs
  double* density;               ///< or its rate
  double* velocity_gradient[4];  ///< L, row by row
  double* acceleration[2];
  double* wall_acceleration[2];  ///< the part that walls give
  bool has_fixed;                ///< wall particles that carry the state of whom they meet
  double wall_limit;
  double gravity[2];
};

using PairLoop = void (*)(const PairWork& work, int first_group, int end);

/// Loops over the pairs of some groups. All but sum_density read what find_slopes leaves behind.
struct PairLoops {
  int lanes;
  PairLoop find_slopes;              ///< F = W'(r)/r [1/m4]
  PairLoop sum_density;              ///< sum_j m_j W [kg/m3]
  PairLoop find_density_rate;        ///< sum_j m_j F x_ij . v_ij [kg/m3/s]
  PairLoop find_velocity_gradient;   ///< - sum_j m_j/rho_j v_ij F x_ij^T [1/s]
  PairLoop find_acceleration;        ///< of pressure and viscosity [m/s2], see SphSolver
  PairLoop find_acceleration_whole;  ///< with all of the stress of a viscosity that varies
};

}  // namespace mpm::sph
