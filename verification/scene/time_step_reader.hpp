#pragma once

#include "verification/scene/scene_config.hpp"

namespace verification {

/// Reads dt, or the limits that bound it, into config.time_step; dt = "auto" into config.auto_step besides,
/// with a step that will do until the pilot has run. All else of the scene must be there. Throws ConfigError.
void read_time_step(TomlTable& table, SceneConfig& config);

/// The scene with a number [s] in place of dt = "auto".
SceneConfig with_step(const SceneConfig& scene, double dt);

}  // namespace verification
