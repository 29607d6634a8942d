#include "verification/scene/flow_reader.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "verification/flows/channel/channel_flow.hpp"
#include "verification/flows/channel/oscillating_channel_flow.hpp"
#include "verification/flows/channel/stress_driven_flow.hpp"
#include "verification/flows/waves/dilatation_flow.hpp"
#include "verification/flows/waves/periodic_flow.hpp"
#include "verification/flows/waves/tait_column_flow.hpp"
#include "verification/flows/waves/wave_flow.hpp"
#include "verification/scene/scene_keys.hpp"
#include "verification/scene/surface_flow_reader.hpp"
#include "verification/scene/vortex_reader.hpp"

namespace verification {
namespace {

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

FlowPointer read_stress_driven(TomlTable& table, const FluidConfig& fluid) {
  const StressDrivenFlowParameters p{table.positive("height"), read_axis(table, "x"),
                                     read_nonzero(table, "traction"), fluid};
  try {
    return std::make_shared<StressDrivenFlow>(p);
  } catch (const std::invalid_argument& error) {
    table.fail("traction", error.what());
  }
}

FlowPointer read_cessation(TomlTable& table, const FluidConfig& fluid) {
  ChannelParameters p;
  p.height = table.positive("height");
  p.length = table.positive("length", 0);
  p.axis = read_axis(table, "x");
  p.initial_acceleration = read_nonzero(table, "initial_acceleration");
  p.fluid = fluid;
  try {
    return std::make_shared<ChannelFlow>(p);
  } catch (const std::invalid_argument& error) {
    table.fail("flow", error.what());
  }
}

WaveParameters read_wave(TomlTable& table, const FluidConfig& fluid, const std::string& axis) {
  WaveParameters p;
  p.wavelength = table.positive("wavelength");
  p.amplitude = table.positive("amplitude");
  p.axis = read_axis(table, axis);
  p.kinematic_viscosity = newtonian_viscosity(table, fluid);
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

FlowPointer read_oblique_wave(TomlTable& table, const FluidConfig& fluid) {
  ObliqueWaveParameters p;
  p.length = table.positive("length");
  const std::vector<int> waves = table.integers("waves");
  if (waves.size() != 2 || (waves[0] == 0 && waves[1] == 0))
    table.fail("waves", "must be a pair of whole numbers, waves along x and y, not both zero");
  p.waves = {waves[0], waves[1]};
  p.amplitude = table.positive("amplitude");
  if (table.has("stream")) p.stream = read_vector(table, "stream");
  p.kinematic_viscosity = newtonian_viscosity(table, fluid);
  p.fluid = fluid.solver;
  return std::make_shared<ObliqueWaveFlow>(p);
}

FlowPointer read_translation(TomlTable& table, const FluidConfig& fluid) {
  TranslationParameters p;
  p.length = table.positive("length");
  p.velocity = read_vector(table, "velocity");
  if (p.velocity.norm() == 0) table.fail("velocity", "must not be zero: no relative error would exist");
  p.density_ratio = table.positive("density_ratio", 1);
  p.fluid = fluid.solver;
  return std::make_shared<TranslationFlow>(p);
}

FlowPointer read_oscillating(TomlTable& table, const FluidConfig& fluid, bool plate) {
  OscillatingChannelFlowParameters p;
  p.height = table.positive("height");
  p.axis = read_axis(table, "x");
  p.frequency = table.positive("frequency");
  (plate ? p.plate_velocity : p.body_acceleration) =
      read_nonzero(table, plate ? "plate_velocity" : "body_acceleration");
  p.kinematic_viscosity = newtonian_viscosity(table, fluid);
  p.fluid = fluid.solver;
  return std::make_shared<OscillatingChannelFlow>(p);
}

FlowPointer read_tait_column(TomlTable& table, const FluidConfig& fluid) {
  if (!fluid.solver.pressure) table.fail("flow", "a column at rest needs fluid.pressure = true");
  TaitColumnFlowParameters p;
  p.height = table.positive("height");
  p.axis = read_axis(table, "y");
  p.density_contrast = table.positive("density_contrast");
  p.fluid = fluid.solver;
  return std::make_shared<TaitColumnFlow>(p);
}

FlowPointer read_dilatation(TomlTable& table, const FluidConfig& fluid) {
  if (!fluid.solver.pressure)
    table.fail("flow", "needs fluid.pressure = true, or density would not change; give a tiny bulk_modulus");
  DilatationFlowParameters p;
  p.length = table.positive("length");
  p.axis = read_axis(table, "x");
  p.rate = table.number("rate");
  if (!(p.rate < 0)) table.fail("rate", "must be negative: an expanding fluid would leave the grid");
  p.fluid = fluid.solver;
  return std::make_shared<DilatationFlow>(p);
}

using Reader = std::function<FlowPointer(TomlTable&, const FluidConfig&)>;

const std::vector<std::pair<std::string, Reader>>& readers() {
  static const std::vector<std::pair<std::string, Reader>> table = {
      {"poiseuille", [](TomlTable& t, const FluidConfig& f) { return read_channel(t, f, true, false); }},
      {"couette", [](TomlTable& t, const FluidConfig& f) { return read_channel(t, f, false, true); }},
      {"couette-poiseuille",
       [](TomlTable& t, const FluidConfig& f) { return read_channel(t, f, true, true); }},
      {"cessation", read_cessation},
      {"stress-driven-couette", read_stress_driven},
      {"acoustic-wave", read_acoustic_wave},
      {"shear-wave", read_shear_wave},
      {"oblique-shear-wave", read_oblique_wave},
      {"translation", read_translation},
      {"tait-column", read_tait_column},
      {"uniform-dilatation", read_dilatation},
      {"oscillating-plate", [](TomlTable& t, const FluidConfig& f) { return read_oscillating(t, f, true); }},
      {"womersley", [](TomlTable& t, const FluidConfig& f) { return read_oscillating(t, f, false); }},
      {"taylor-green", read_taylor_green},
      {"double-shear-layer", read_double_shear_layer},
      {"walled-vortex", read_walled_vortex},
      {"lid-driven-cavity", read_cavity},
      {"manufactured", read_manufactured},
      {"gravity-current", read_gravity_current},
      {"standing-wave", read_standing_wave},
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
