#pragma once

#include "verification/runs/run_data.hpp"

namespace verification {

// Scalars that checks observe. Each is NaN when a run did not reach the time asked for: a NaN never passes.

/// Mean of (numerical - exact) streamwise velocity over the particles of the middle half of the gap, in units
/// of h^2 F/nu. Theory for FLIP with the linear basis and 2 rows a cell: +3/32 in the steady state (DESIGN,
/// section 4).
double particle_bias(const RunData& run, double t);

/// Largest difference between the velocities (streamwise and across) of two runs at equal places across the
/// flow, relative to the velocity scale; NaN when a place of `run` has no counterpart.
double largest_difference(const RunData& run, const RunData& other, double t, Location location);

/// Largest |mass(t) - mass(0)|/mass(0) over the history.
double mass_drift(const RunData& run);

/// Largest |momentum(t) - momentum(0) - impulse(t)| over the history, relative to the largest momentum there
/// was, or to mass times velocity scale if that is larger (a wave's momentum is zero).
double momentum_drift(const RunData& run);

}  // namespace verification
