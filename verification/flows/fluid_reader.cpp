#include "verification/flows/fluid_reader.hpp"

namespace verification {

FluidConfig read_fluid(TomlTable table) {
  FluidConfig fluid;
  fluid.label = table.text("model", "newtonian");
  if (fluid.label != "newtonian")
    table.fail("model", "'" + fluid.label + "' is not known; choose one of: newtonian");
  fluid.kinematic_viscosity = table.positive("kinematic_viscosity");
  fluid.solver.density = table.positive("density", 1000);
  fluid.solver.pressure = table.flag("pressure", true);
  table.accept("bulk_modulus");
  table.refuse_unknown_keys();  // before the next line: a misspelt `pressure` would be told as a missing
                                // modulus
  if (fluid.solver.pressure) fluid.solver.bulk_modulus = table.positive("bulk_modulus");
  fluid.solver.rheology = mpm::Newtonian{fluid.kinematic_viscosity * fluid.solver.density};
  return fluid;
}

}  // namespace verification
