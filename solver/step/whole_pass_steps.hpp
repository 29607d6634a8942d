#pragma once

#include <numbers>

#include "solver/linear_algebra.hpp"

namespace mpm {

// The stepping rules that Passes alone carries out: of second order, and with implicit viscosity. Each call
// is one loop over particles or nodes, or one linear solve.

/// Second order: half a drift of positions and densities, a kick of the velocities by the explicit midpoint
/// rule, half a drift (Strang splitting). Without viscosity it is the leapfrog (Stoermer-Verlet), which holds
/// sound waves neutrally stable; without sound it is the midpoint rule for the viscous stress.
template <class Passes>
void step_leapfrog(Passes& passes, double t, double dt) {
  passes.drift(t, dt / 2);
  passes.particles_to_grid(t);
  passes.keep_start_velocity();
  passes.half_kick(t, dt);
  passes.kick_from_middle(t, dt);
  passes.grid_to_particles(dt);
  passes.close_drift(t + dt, dt / 2);
}

/// Viscosity by backward Euler, pressure as in USF: bounded by sound alone.
template <class Passes>
void step_implicit_euler(Passes& passes, double t, double dt) {
  passes.particles_to_grid(t);
  passes.keep_start_velocity();
  passes.compress(dt);
  passes.set_pressure();
  passes.forces(t + dt);
  const Vec2 wall_impulse = passes.solve_viscosity(passes.start_velocity(), t + dt, dt, 1);
  passes.add_impulse(dt * passes.body_force() + wall_impulse);
  passes.accelerate_from_start(dt);
  passes.grid_to_particles(dt);
  passes.move_with_grid(dt);
}

/// As the leapfrog, with the kick by a singly diagonally implicit Runge-Kutta rule of two stages (Alexander
/// 1977): second order, L-stable, so that an impulsive start dies out at once.
template <class Passes>
void step_implicit_sdirk2(Passes& passes, double t, double dt) {
  constexpr double gamma = 1 - 0.5 * std::numbers::sqrt2;
  constexpr double carry = (1 - gamma) / gamma;
  passes.drift(t, dt / 2);
  passes.particles_to_grid(t);
  passes.keep_start_velocity();
  passes.set_pressure();

  passes.forces(t + gamma * dt);
  Vec2 wall_impulse = carry * passes.solve_viscosity(passes.start_velocity(), t + gamma * dt, gamma * dt,
                                                     gamma / (1 - gamma));
  Vec2 body_impulse = (1 - gamma) * dt * passes.body_force();
  const VectorField& second_start = passes.carried_velocity(carry);

  passes.forces(t + dt);
  wall_impulse += passes.solve_viscosity(second_start, t + dt, gamma * dt, (1 - gamma) / gamma);
  body_impulse += gamma * dt * passes.body_force();

  passes.add_impulse(body_impulse + wall_impulse);
  passes.accelerate_from_start(dt);
  passes.grid_to_particles(dt);
  passes.close_drift(t + dt, dt / 2);
}

}  // namespace mpm
