#include "verification/flows/flow_reader.hpp"

#include <functional>
#include <utility>

#include "verification/flows/box_flow.hpp"
#include "verification/flows/channel_flow.hpp"
#include "verification/flows/manufactured_flow.hpp"
#include "verification/flows/taylor_green_flow.hpp"
#include "verification/flows/wave_flow.hpp"

namespace verification {
namespace {

using FlowPointer = std::shared_ptr<const Flow>;

int read_axis(TomlTable& table, const std::string& absent) {
  const std::string axis = table.text("axis", absent);
  if (axis != "x" && axis != "y") table.fail("axis", "must be \"x\" or \"y\"");
  return axis == "x" ? 0 : 1;
}

double read_nonzero(TomlTable& table, const std::string& key) {
  const double value = table.number(key);
  if (value == 0) table.fail(key, "must not be zero: nothing would move and no relative error exists");
  return value;
}

Vec2 read_vector(TomlTable& table, const std::string& key) {
  const std::vector<double> values = table.numbers(key);
  if (values.size() != 2) table.fail(key, "must be a pair [x, y]");
  return {values[0], values[1]};
}

FlowPointer read_channel(TomlTable& table, const FluidConfig& fluid, bool driven, bool plate) {
  ChannelParameters p;
  p.height = table.positive("height");
  p.length = table.positive("length", 0);
  p.axis = read_axis(table, "x");
  if (driven) p.body_acceleration = read_nonzero(table, "body_acceleration");
  if (plate) p.plate_velocity = read_nonzero(table, "plate_velocity");
  p.fluid = fluid;
  try {
    return std::make_shared<ChannelFlow>(p);
  } catch (const std::invalid_argument& error) {
    table.fail("flow", error.what());
  }
}

WaveParameters read_wave(TomlTable& table, const FluidConfig& fluid, const std::string& axis) {
  const auto nu = fluid.curve.newtonian();
  if (!nu) table.fail("flow", "has an exact solution for a Newtonian fluid only");
  WaveParameters p;
  p.wavelength = table.positive("wavelength");
  p.amplitude = table.positive("amplitude");
  p.axis = read_axis(table, axis);
  p.kinematic_viscosity = *nu;
  p.fluid = fluid.solver;
  return p;
}

FlowPointer read_acoustic_wave(TomlTable& table, const FluidConfig& fluid) {
  if (!fluid.solver.pressure) table.fail("flow", "an acoustic wave needs fluid.pressure = true");
  return std::make_shared<AcousticWaveFlow>(read_wave(table, fluid, "x"));
}

FlowPointer read_shear_wave(TomlTable& table, const FluidConfig& fluid) {
  WaveParameters p = read_wave(table, fluid, "y");
  if (table.has("stream")) p.stream = read_vector(table, "stream");
  return std::make_shared<ShearWaveFlow>(p);
}

FlowPointer read_taylor_green(TomlTable& table, const FluidConfig& fluid) {
  const auto nu = fluid.curve.newtonian();
  if (!nu) table.fail("flow", "has an exact solution for a Newtonian fluid only");
  if (!fluid.solver.pressure)
    table.fail("flow", "a vortex needs fluid.pressure = true: pressure balances its advection");
  TaylorGreenFlowParameters p{table.positive("period"), table.positive("amplitude"), *nu, fluid.solver};
  if (p.amplitude >= 0.5 * p.fluid.sound_speed())
    table.fail("amplitude",
               "must be below half the speed of sound sqrt(7 K/rho0): the vortex is incompressible");
  return std::make_shared<TaylorGreenFlow>(p);
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

mpm::Side read_side(TomlTable& table, const std::string& key) {
  if (!table.has(key)) return mpm::Side::joined();
  return mpm::Side::wall(read_vector(table, key));
}

FlowPointer read_box(TomlTable& table, const FluidConfig& fluid) {
  BoxParameters p;
  p.size = {table.positive("width"), table.positive("height")};
  TomlTable walls = table.table("walls");
  p.sides = {read_side(walls, "left"), read_side(walls, "right"), read_side(walls, "bottom"),
             read_side(walls, "top")};
  walls.refuse_unknown_keys();
  if (table.has("body_acceleration")) p.body_acceleration = read_vector(table, "body_acceleration");
  if (table.has("initial_velocity")) p.initial_velocity = read_vector(table, "initial_velocity");
  p.velocity_scale = table.positive("velocity_scale");
  p.fluid = fluid.solver;
  return std::make_shared<BoxFlow>(p);
}

using Reader = std::function<FlowPointer(TomlTable&, const FluidConfig&)>;

const std::vector<std::pair<std::string, Reader>>& readers() {
  static const std::vector<std::pair<std::string, Reader>> table = {
      {"poiseuille", [](TomlTable& t, const FluidConfig& f) { return read_channel(t, f, true, false); }},
      {"couette", [](TomlTable& t, const FluidConfig& f) { return read_channel(t, f, false, true); }},
      {"couette-poiseuille",
       [](TomlTable& t, const FluidConfig& f) { return read_channel(t, f, true, true); }},
      {"acoustic-wave", read_acoustic_wave},
      {"shear-wave", read_shear_wave},
      {"taylor-green", read_taylor_green},
      {"manufactured", read_manufactured},
      {"box", read_box},
  };
  return table;
}

}  // namespace

std::shared_ptr<const Flow> read_flow(TomlTable table, const FluidConfig& fluid) {
  const std::string flow = table.text("flow");
  std::string known;
  for (const auto& [name, read] : readers()) {
    if (name == flow) {
      auto result = read(table, fluid);
      table.refuse_unknown_keys();
      return result;
    }
    known += (known.empty() ? "" : ", ") + name;
  }
  table.fail("flow", "'" + flow + "' is not known; choose one of: " + known);
}

}  // namespace verification
