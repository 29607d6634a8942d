#include "verification/flows/fluid_reader.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace verification {
namespace {

/// The model as solver and reference know it; the two share nothing but the user's numbers.
struct Model {
  std::string label;
  mpm::Rheology rheology;
  reference::FlowCurve curve;
};

// Readers take the table, nu_0 [m2/s], the density [kg/m3] and the cells across the flow.

Model read_newtonian(TomlTable&, double nu, double density, int) {
  return {"newtonian", mpm::Newtonian{nu * density}, reference::NewtonianCurve{nu}};
}

Model read_cross(TomlTable& table, double nu, double density, int) {
  const double a = table.positive("infinite_viscosity_ratio");
  const double K = table.positive("time_constant");
  const double M = table.positive("exponent", 1);
  const double mu = nu * density;
  const reference::CrossCurve curve{nu, a * nu, K, M};
  if (M == 1) return {fmt::format("cross a={}", a), mpm::Cross<mpm::SquareRoot>{mu, a * mu, K, {}}, curve};
  return {fmt::format("cross a={} M={}", a, M), mpm::Cross<mpm::RealPower>{mu, a * mu, K, {0.5 * M}}, curve};
}

Model read_power_law(TomlTable& table, double nu, double density, int) {
  const double n = table.positive("index");
  const double floor = table.positive("shear_rate_floor", 1e-6);
  const double largest = table.positive("largest_shear_rate", 10);
  return {fmt::format("power-law n={}", n), mpm::PowerLaw{nu * density, n, floor, largest},
          reference::PowerLawCurve{nu, n}};
}

Model read_carreau_yasuda(TomlTable& table, double nu, double density, int) {
  const double ratio = table.positive("infinite_viscosity_ratio");
  const double lambda = table.positive("time_constant");
  const double a = table.positive("yasuda_exponent", 2);
  const double n = table.positive("index");
  const double largest = table.positive("largest_shear_rate", 10);
  const double mu = nu * density;
  return {fmt::format("carreau-yasuda n={}", n), mpm::CarreauYasuda{mu, ratio * mu, lambda, a, n, largest},
          reference::CarreauYasudaCurve{nu, ratio * nu, lambda, a, n}};
}

/// The regularisation m [s]: the user's, or else from the mesh: m = cells^2/largest_shear_rate. In a channel
/// of a Bingham fluid it speeds the plug up by tau_y/(m F) = z_0 w/cells^2 (z_0: half the plug's height, w:
/// the shear rate at the wall). The linear scheme's mesh slows the flow down, on the average over the gap, by
/// about h^2 F/(24 nu) = w H^2/(24 cells^2 (H/2 - z_0)): the first is 24 z_0 (H/2 - z_0)/H^2 <= 1.5 times
/// that. The plug itself loses up to F h^2/(8 nu), where its edge halves a cell, and gains in the layer there
/// (docs/yield-stress.md): both fall as h^2, so that neither is refined in vain, but they do not cancel.
double read_regularisation(TomlTable& table, int cells, double largest) {
  if (table.has("regularisation")) return table.positive("regularisation");
  return static_cast<double>(cells) * cells / largest;
}

Model read_yielding(TomlTable& table, double nu, double density, int cells, double n) {
  const double yield_stress = table.positive("yield_stress");
  const double floor = table.positive("shear_rate_floor", 1e-6);
  const double largest = table.positive("largest_shear_rate", 10);
  const double m = read_regularisation(table, cells, largest);
  return {n == 1 ? fmt::format("bingham tau_y={}", yield_stress)
                 : fmt::format("herschel-bulkley n={} tau_y={}", n, yield_stress),
          mpm::HerschelBulkley{nu * density, n, yield_stress, m, floor, largest},
          reference::HerschelBulkleyCurve{nu, n, yield_stress / density, m}};
}

Model read_herschel_bulkley(TomlTable& table, double nu, double density, int cells) {
  return read_yielding(table, nu, density, cells, table.positive("index"));
}

Model read_bingham(TomlTable& table, double nu, double density, int cells) {
  return read_yielding(table, nu, density, cells, 1);
}

using ModelReader = Model (*)(TomlTable&, double, double, int);
const std::vector<std::pair<std::string, ModelReader>> model_readers = {
    {"newtonian", read_newtonian},
    {"cross", read_cross},
    {"power-law", read_power_law},
    {"carreau-yasuda", read_carreau_yasuda},
    {"herschel-bulkley", read_herschel_bulkley},
    {"bingham", read_bingham},
};

ModelReader reader_of(TomlTable& table) {
  const std::string model = table.text("model", "newtonian");
  std::string known;
  for (const auto& [name, read] : model_readers) {
    if (name == model) return read;
    known += (known.empty() ? "" : ", ") + name;
  }
  table.fail("model", "'" + model + "' is not known; choose one of: " + known);
}

}  // namespace

bool is_incompressible(TomlTable& fluid) {
  if (!fluid.is_text("pressure")) return false;
  if (fluid.text("pressure") != "incompressible")
    fluid.fail("pressure", "must be true, false or \"incompressible\"");
  return true;
}

FluidConfig read_fluid(TomlTable table, int cells, bool needs_no_modulus) {
  FluidConfig fluid;
  const ModelReader read_model = reader_of(table);
  fluid.kinematic_viscosity = table.positive("kinematic_viscosity");
  fluid.solver.density = table.positive("density", 1000);
  fluid.incompressible = is_incompressible(table);
  fluid.solver.pressure = !fluid.incompressible && table.flag("pressure", true);
  try {
    const Model model = read_model(table, fluid.kinematic_viscosity, fluid.solver.density, cells);
    fluid.label = model.label;
    fluid.solver.rheology = model.rheology;
    fluid.curve = model.curve;
  } catch (const std::invalid_argument& error) {
    table.fail("model", error.what());
  }
  if (fluid.incompressible && table.has("bulk_modulus"))
    table.fail("bulk_modulus", "has no meaning beside pressure = \"incompressible\": remove it");
  table.accept("bulk_modulus");
  table.refuse_unknown_keys();  // before the next line: a misspelt `pressure` would be told as a missing
                                // modulus
  if (!fluid.solver.pressure) return fluid;
  fluid.without_modulus = needs_no_modulus && !table.has("bulk_modulus");
  const double c = unreached_sound_speed;
  fluid.solver.bulk_modulus =
      fluid.without_modulus ? fluid.solver.density * c * c / 7 : table.positive("bulk_modulus");
  return fluid;
}

}  // namespace verification
