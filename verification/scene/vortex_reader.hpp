#pragma once

#include <memory>

#include "verification/config/toml_table.hpp"
#include "verification/flows/flow.hpp"
#include "verification/flows/fluid_reader.hpp"

namespace verification {

using FlowPointer = std::shared_ptr<const Flow>;

// Readers of [scene] for the flows of flows/vortices; they throw ConfigError.
FlowPointer read_taylor_green(TomlTable& table, const FluidConfig& fluid);
FlowPointer read_walled_vortex(TomlTable& table, const FluidConfig& fluid);
FlowPointer read_double_shear_layer(TomlTable& table, const FluidConfig& fluid);
FlowPointer read_cavity(TomlTable& table, const FluidConfig& fluid);
FlowPointer read_manufactured(TomlTable& table, const FluidConfig& fluid);

}  // namespace verification
