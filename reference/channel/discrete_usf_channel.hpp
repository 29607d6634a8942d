#pragma once

#include <vector>

namespace reference {

/// A Newtonian channel as the update-stress-first (USF) material point method with linear basis functions,
/// lumped mass and FLIP transfer resolves it. SI units.
struct DiscreteUsfChannelParameters {
  double height = 0.0;               ///< H [m] > 0
  int cells = 0;                     ///< N >= 2, across the gap; h = H/N
  int particles_per_cell = 0;        ///< p >= 1, across one cell, at (i + 1/2)/p of it
  double kinematic_viscosity = 0.0;  ///< nu [m2/s] > 0
  double body_acceleration = 0.0;    ///< F [m/s2]
  double plate_velocity = 0.0;       ///< V0 [m/s] of the plate at y = H, from t = 0
  double time_step = 0.0;            ///< dt [s] > 0; stable or not, the solution holds
};

/// The exact solution of that *scheme*, not of the flow: a solver of this kind must match it to round-off.
///
/// With A_i the sum of dt times the nodal accelerations (A_0 = 0, A_N = V0 at the walls), particle velocities
/// are v_p = sum_i N_i(y_p) A_i and the lumped projection gives v = S A at the interior nodes, S having rows
/// (q, 1-2q, q) with q the mean of xi (1-xi) over the particles of a cell. One step is v <- v + dt S (F + L
/// v), L = nu/h^2 (1,-2,1), so v minus its steady state decays mode by mode: sin(k pi j/N) by 1 - dt S_k
/// lambda_k, S_k = 1 - 4 q sin^2(theta_k/2), lambda_k = 4 nu/h^2 sin^2(theta_k/2), theta_k = k pi/N. Start:
/// particles at rest but for the wall node's share of an impulsively started plate, A_i = 0 inside.
class DiscreteUsfChannel {
 public:
  /// Throws std::invalid_argument for arguments out of the ranges above, or not finite.
  explicit DiscreteUsfChannel(const DiscreteUsfChannelParameters& parameters);

  /// Nodal velocities [m/s] projected from the particles after `step` steps, size cells + 1, from y = 0 up;
  /// walls carry their own velocity. Throws std::invalid_argument for step < 0.
  [[nodiscard]] std::vector<double> node_velocity(long step) const;

  /// Particle velocities [m/s] after `step` steps, size cells * particles_per_cell, one a row, from y = 0 up.
  /// In the steady state and away from the walls they exceed the parabola by half q h^2 F/nu: (3/32) h^2 F/nu
  /// for p = 2.
  [[nodiscard]] std::vector<double> particle_velocity(long step) const;

  /// Heights [m] of the particle rows, in the order of particle_velocity.
  [[nodiscard]] std::vector<double> particle_height() const;

  /// q: mean of xi (1 - xi) over the particles of a cell; 3/16 for p = 2.
  [[nodiscard]] double neighbour_weight() const { return q_; }

 private:
  [[nodiscard]] double growth(int k, long step) const;
  [[nodiscard]] std::vector<double> from_modes(const std::vector<double>& modes) const;
  [[nodiscard]] double symbol(int k) const;

  DiscreteUsfChannelParameters parameters_;
  double q_;
  std::vector<double> sine_;      // sin(pi m/N), m = 0..2N-1
  std::vector<double> start_;     // sine modes of v(0) minus the steady state
  std::vector<double> parabola_;  // sine modes of the steady parabola
  std::vector<double> steady_;    // steady nodal values
};

}  // namespace reference
