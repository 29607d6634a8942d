#pragma once

#include <memory>

#include "verification/config/toml_table.hpp"
#include "verification/flows/flow.hpp"
#include "verification/flows/fluid_reader.hpp"

namespace verification {

/// Reads [scene]: `flow` names the problem, the other keys are that problem's own. Throws ConfigError.
std::shared_ptr<const Flow> read_flow(TomlTable table, const FluidConfig& fluid);

}  // namespace verification
