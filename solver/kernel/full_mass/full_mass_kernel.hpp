#pragma once

#include <memory>
#include <vector>

#include "solver/kernel/kernel.hpp"
#include "solver/kernel/threads/thread_team.hpp"

namespace mpm {

// The interface to the vector kernels of the consistent mass, for planes: particles that stand for the grid's
// own field (FullMass, solver/transfer/transfer.hpp), moved along straight lines. Components and plain data
// as in kernel.hpp.

/// What the matrix of a uniform fluid is along an axis, and what comes near its inverse (line_mass(),
/// solver/lanes): the entries within `reach` of the diagonal, entry (i, i + d) at (d + reach) * count + i
/// [1/m].
struct LineMass {
  int reach, count;
  std::vector<double> diagonal, inverse;  ///< [m], [1/m]
};

/// A sum over all nodes before and after a solve: sum_i b_i and sum_i m_i x_i of M x = b.
struct Balance {
  double asked[2], found[2];
};

/// Sums over the particles, per unit depth.
struct KernelTotals {
  double mass, momentum[2], kinetic_energy;  ///< [kg/m], [kg/s], [J/m]
};

/// The kicks of a step, each with solutions that it begins from: to the middle of it, and the whole one.
enum class Kick { ToMiddle, Whole };

/// Nodes are numbered row * stride + i over those that have a value of their own; images of periodic nodes
/// are the kernel's business.
class FullMassKernel {
 public:
  virtual ~FullMassKernel() = default;

  /// Writes all particles in the order in which they came.
  virtual void gather(PointState* points) const = 0;
  [[nodiscard]] virtual KernelTotals totals() = 0;

  [[nodiscard]] virtual int stride() const = 0;
  /// What walls prescribe of the field that is solved for next, a component; read on wall nodes alone.
  virtual double* prescribed(int component) = 0;
  /// The field that was solved for last.
  [[nodiscard]] virtual const double* velocity(int component) const = 0;

  /// P2G: M_ij = sum_p m_p N_ip N_jp, v = M^-1 sum_p N_ip m_p v_p. `v` is what the step starts with, too.
  virtual Balance project() = 0;
  /// The same for who asks between steps: none of them is the wiser.
  virtual Balance project_aside() = 0;
  /// v = v_start + dt a with a = M^-1 f, f_i = m_i b + sum_p N_ip m_p b_p - sum_p V_p sigma_p grad N_ip,
  /// sigma of the nodal velocity before. dt [s].
  virtual Balance kick(Kick which, const double body_acceleration[2], double dt) = 0;
  /// G2P: v_p = v(x_p) and its gradient.
  virtual void take() = 0;
  /// sigma_p of the nodal velocity.
  virtual void set_stress() = 0;
  /// Moves the particles along straight lines (solver/transfer/straight_drift.hpp).
  virtual Motion drift(double dt) = 0;
  /// sqrt(2 D:D) of the nodal velocity at the particle where it is largest [1/s].
  [[nodiscard]] virtual double largest_strain_rate() = 0;

  /// Puts the particles back where they were at the start, with what the grid knows of the fluid
  /// (ParticleReset, solver/transfer).
  virtual void reset() = 0;

  /// Where the particles are, in an order that stands until they move [m].
  virtual void positions(double* const x[2]) const = 0;
  /// b_p in that order [m/s2], zero until it is set. Returns sum_p m_p b_p through `force` [N/m].
  virtual void accelerate_particles(const double* const b[2], double force[2]) = 0;
};

struct FullMassSetup {
  KernelSetup particles;  ///< where they are, and of which fluid
  /// By axis: of the functions that walls prescribe not, and of all.
  std::array<LineMass, 2> mass, whole_mass;
  std::vector<int> wall_nodes;  ///< row * count along + i
  bool resets;                  ///< whether reset() will be called
  double negligible_mass;       ///< functions whose M_ii is below this part of the largest are left out
  ThreadTeam* team;             ///< outlives the kernel
};

}  // namespace mpm
