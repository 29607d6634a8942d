#pragma once

#include "verification/scene/scene_keys.hpp"

namespace verification {

// Readers of [scene] for flows whose fluid may fill a part of the box. They throw ConfigError.

FlowPointer read_box(TomlTable& table, const FluidConfig& fluid);
FlowPointer read_gravity_current(TomlTable& table, const FluidConfig& fluid);
FlowPointer read_standing_wave(TomlTable& table, const FluidConfig& fluid);

}  // namespace verification
