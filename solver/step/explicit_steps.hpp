#pragma once

#include "solver/scene/scheme.hpp"

namespace mpm {

// The explicit stepping rules of first order, each written once for either set of passes: Passes, whose loops
// run over everything one after another, or LanePasses on the vector kernels. A step is a sequence of stages:
// a stage finds the nodes complete to which the one before has added, so that LanePasses may visit the grid
// with all of them a few rows apart (solver/kernel/threads/sweep.hpp). What stands in one call is one loop
// there.

/// Update stress first: strain rate from the velocity at the start of the step.
template <class Passes>
void step_usf(Passes& passes, double t, double dt) {
  passes.in_turn(
      t, dt, [](auto& stage) { stage.particles_to_grid(); },
      [](auto& stage) { stage.update_stress_and_accelerate(); }, [](auto& stage) { stage.take_and_move(); });
}

/// Update stress last: strain rate from the nodal velocity at the end of the step.
template <class Passes>
void step_usl(Passes& passes, double t, double dt) {
  passes.in_turn(
      t, dt, [](auto& stage) { stage.particles_to_grid(); }, [](auto& stage) { stage.accelerate(); },
      [](auto& stage) {
        stage.update_stress();
        stage.take_and_move();
      });
}

/// Modified update stress last: strain rate from the updated particles mapped back to the grid, with the
/// shape functions of the start of the step.
template <class Passes>
void step_musl(Passes& passes, double t, double dt) {
  passes.in_turn(
      t, dt, [](auto& stage) { stage.particles_to_grid(); }, [](auto& stage) { stage.accelerate(); },
      [](auto& stage) {
        stage.take();
        stage.map_updated_velocity();
      },
      [](auto& stage) {
        stage.update_stress_from_mapped();
        stage.move();
      });
}

/// Stages of a step.
constexpr int stages_of(Scheme::Stepping stepping) {
  return stepping == Scheme::Stepping::Musl ? 4 : 3;
}

}  // namespace mpm
