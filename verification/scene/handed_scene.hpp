#pragma once

#include <string>

#include "verification/scene/scene_config.hpp"

namespace verification {

/// Version of the protocol between this program and somebody else's solver (docs/protocol.md).
inline constexpr int protocol_version = 1;

/// What somebody else's solver is given to solve, as TOML: the scene with every default written out, the
/// version of the protocol, the domain and the meaning of its coordinates, the field at the start in words,
/// and the solver's own options (TOML text of a table [solver.options]; "" for none).
std::string handed_scene(const SceneConfig& scene, const std::string& options);

/// The field at the start of a flow in words, by its name in scene.flow; "" for one that is not known.
std::string start_in_words(const std::string& flow);

}  // namespace verification
