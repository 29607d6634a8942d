#pragma once

#include <string>
#include <vector>

#include "verification/scene/scene_config.hpp"

namespace verification {

/// What one simulation will take, estimated from its scene before anything of it is made. Doubles: what a
/// user writes by mistake overflows integers.
struct SceneCost {
  double particles = 0, nodes = 0, steps = 0;
  double bytes = 0;    ///< of the solver's fields and of the rows that it will write, at its largest
  double seconds = 0;  ///< on one core at particle_steps_per_second
};

/// What one core of a present machine does with the solver's plain loops; an estimate, and said to be one.
inline constexpr double particle_steps_per_second = 20e6;

/// Of a scene whose segments may not be planned yet: then steps and seconds are zero.
SceneCost cost_of(const SceneConfig& scene);

/// "1600 particles, 2000 steps of at most 5e-06 s, about 0.16 s on one core"
std::string described_cost(const SceneConfig& scene);

/// Refuses, with the numbers, a scene that cannot fit into this machine's memory; and, once its steps are
/// planned, one that would take more than a year. Throws ConfigError that names file and key.
void require_memory(const TomlTable& root, const SceneConfig& scene);
void require_steps(const TomlTable& root, const SceneConfig& scene);

/// Says in which respect the step exceeds what the scheme is known to bear (solver/step/stable_step.hpp); ""
/// if in none.
std::string step_warning(const SceneConfig& scene);

/// Longest step that accuracy allows where viscosity, being implicit, does not bound it [s].
double accurate_implicit_step(const SceneConfig& scene);

}  // namespace verification
