#pragma once

#include "verification/runs/run_data.hpp"

namespace verification {

/// Runs one planned simulation with our solver and takes its profiles, history and timing. A run that breaks
/// down is recorded ("diverged at t = ..."); its profiles end with the last output reached. Throws
/// Interrupted when a signal has come (interruption.hpp).
RunData run_simulation(const Study& study, const PlannedRun& plan);

/// Whether the first simulation, of so many seconds, is timed like the others: what cold caches and pages
/// cost, milliseconds, is a small part of a long one, and the fastest counts. Where one time is `asked` for,
/// there is no faster one: it must be five times as long.
bool warms_itself(int asked, double wall);

/// Whether a run is to be timed again after these times [s], `asked` times at most: no more than twice, whose
/// difference shows the noise, once a quarter of a second has been measured. What disturbs a run comes in
/// bursts of milliseconds; a long one averages over them.
bool wants_repetition(int asked, const std::vector<double>& walls);

/// The reference that a run needs and that takes long to compute (Flow::costly_reference).
std::optional<CostlyReference> costly_reference(const Study& study, const SceneConfig& scene);

/// What the study compares a scene with; null where nothing is known.
std::shared_ptr<const ExactField> compared_with(const Study& study, const SceneConfig& scene);

/// Shear rate and viscosity of the exact solution on the same points; empty but for channels.
std::vector<reports::ShearRow> exact_shear(const SceneConfig& scene, const ExactField& exact);

/// A row of an exact density and of the pressure that goes with it; numerical columns NaN.
reports::StateRow exact_state_at(const SceneConfig& scene, double t, const std::string& location,
                                 const Vec2& x, double exact_density);

/// Density and pressure of the exact solution on its fine line; empty where it has no density.
std::vector<reports::StateRow> exact_state(const SceneConfig& scene, const ExactField& exact);

/// Fine exact lines at the output times, for figures and for `reference`.
std::vector<reports::ProfileRow> exact_lines(const SceneConfig& scene, const ExactField& exact);

}  // namespace verification
