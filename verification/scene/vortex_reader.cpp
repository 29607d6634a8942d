#include "verification/scene/vortex_reader.hpp"

#include "verification/flows/vortices/double_shear_layer_flow.hpp"
#include "verification/flows/vortices/lid_driven_cavity_flow.hpp"
#include "verification/flows/vortices/manufactured_flow.hpp"
#include "verification/flows/vortices/taylor_green_flow.hpp"
#include "verification/flows/vortices/walled_vortex_flow.hpp"
#include "verification/scene/scene_keys.hpp"

namespace verification {
namespace {

/// Vortices whose advection pressure balances: of no use to a scene without any.
void require_vortex_pressure(const TomlTable& table, const FluidConfig& fluid) {
  if (!fluid.solver.pressure && !fluid.incompressible)
    table.fail("flow",
               "a vortex needs fluid.pressure = true or \"incompressible\": pressure balances its advection");
}

}  // namespace

FlowPointer read_taylor_green(TomlTable& table, const FluidConfig& fluid) {
  const double nu = newtonian_viscosity(table, fluid);
  require_vortex_pressure(table, fluid);
  TaylorGreenFlowParameters p{table.positive("period"), table.positive("amplitude"), nu, fluid.solver};
  if (!fluid.incompressible && p.amplitude >= 0.5 * p.fluid.sound_speed())
    table.fail("amplitude",
               "must be below half the speed of sound sqrt(7 K/rho0): the vortex is incompressible");
  return std::make_shared<TaylorGreenFlow>(p);
}

FlowPointer read_cavity(TomlTable& table, const FluidConfig& fluid) {
  if (!fluid.solver.pressure && !fluid.incompressible)
    table.fail("flow",
               "a cavity needs fluid.pressure = true or \"incompressible\": pressure balances its advection");
  LidDrivenCavityParameters p{table.positive("side"), table.positive("lid_velocity"), false, fluid.curve,
                              fluid.solver};
  const std::string lid = table.text("lid", "uniform");
  if (lid != "uniform" && lid != "regularised")
    table.fail("lid", "'" + lid + "' is not known; choose one of: uniform, regularised");
  p.smooth = lid == "regularised";
  if (p.smooth && !fluid.incompressible)
    table.fail("lid", "\"regularised\" needs fluid.pressure = \"incompressible\"");
  if (!fluid.incompressible && p.lid_velocity >= 0.5 * p.fluid.sound_speed())
    table.fail("lid_velocity",
               "must be below half the speed of sound sqrt(7 K/rho0): the tables are of incompressible flow");
  return std::make_shared<LidDrivenCavityFlow>(p);
}

FlowPointer read_walled_vortex(TomlTable& table, const FluidConfig& fluid) {
  require_vortex_pressure(table, fluid);
  reference::WalledVortexParameters p;
  p.kinematic_viscosity = newtonian_viscosity(table, fluid);
  p.side = table.positive("side");
  p.amplitude = table.positive("amplitude");
  if (table.has("decay_rate")) p.decay_rate = table.positive("decay_rate");
  return std::make_shared<WalledVortexFlow>(p, fluid.solver);
}

FlowPointer read_double_shear_layer(TomlTable& table, const FluidConfig& fluid) {
  require_vortex_pressure(table, fluid);
  DoubleShearLayerParameters p;
  p.period = table.positive("period");
  p.amplitude = table.positive("amplitude");
  p.thickness = table.positive("thickness");
  p.disturbance = table.positive("disturbance", 0.05);
  p.fluid = fluid.solver;
  return std::make_shared<DoubleShearLayerFlow>(p);
}

FlowPointer read_manufactured(TomlTable& table, const FluidConfig& fluid) {
  reference::ManufacturedParameters p;
  p.height = table.positive("height");
  p.length = table.positive("length", p.height);
  p.plate_velocity = table.positive("plate_velocity");
  p.amplitude = table.positive("amplitude");
  p.angular_frequency = table.number("angular_frequency");
  p.curve = fluid.curve;
  try {
    return std::make_shared<ManufacturedFlow>(p, fluid);
  } catch (const std::invalid_argument& error) {
    table.fail("amplitude", error.what());
  }
}

}  // namespace verification
