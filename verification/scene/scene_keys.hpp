#pragma once

#include <memory>

#include "verification/config/toml_table.hpp"
#include "verification/flows/flow.hpp"
#include "verification/flows/fluid_reader.hpp"

namespace verification {

// What readers of flows share.

using FlowPointer = std::shared_ptr<const Flow>;

/// A pair [x, y].
inline Vec2 read_vector(TomlTable& table, const std::string& key) {
  const std::vector<double> values = table.numbers(key);
  if (values.size() != 2) table.fail(key, "must be a pair [x, y]");
  return {values[0], values[1]};
}

/// [m2/s]; refuses other fluids.
inline double newtonian_viscosity(const TomlTable& table, const FluidConfig& fluid) {
  const auto nu = fluid.curve.newtonian();
  if (!nu) table.fail("flow", "has an exact solution for a Newtonian fluid only");
  return *nu;
}

}  // namespace verification
