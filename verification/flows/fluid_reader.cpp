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

// Readers take the table, nu_0 [m2/s] and the density [kg/m3].

Model read_newtonian(TomlTable&, double nu, double density) {
  return {"newtonian", mpm::Newtonian{nu * density}, reference::NewtonianCurve{nu}};
}

Model read_cross(TomlTable& table, double nu, double density) {
  const double a = table.positive("infinite_viscosity_ratio");
  const double K = table.positive("time_constant");
  const double M = table.positive("exponent", 1);
  const double mu = nu * density;
  const reference::CrossCurve curve{nu, a * nu, K, M};
  if (M == 1) return {fmt::format("cross a={}", a), mpm::Cross<mpm::SquareRoot>{mu, a * mu, K, {}}, curve};
  return {fmt::format("cross a={} M={}", a, M), mpm::Cross<mpm::RealPower>{mu, a * mu, K, {0.5 * M}}, curve};
}

Model read_power_law(TomlTable& table, double nu, double density) {
  const double n = table.positive("index");
  const double floor = table.positive("shear_rate_floor", 1e-6);
  const double largest = table.positive("largest_shear_rate", 10);
  return {fmt::format("power-law n={}", n), mpm::PowerLaw{nu * density, n, floor, largest},
          reference::PowerLawCurve{nu, n}};
}

Model read_carreau_yasuda(TomlTable& table, double nu, double density) {
  const double ratio = table.positive("infinite_viscosity_ratio");
  const double lambda = table.positive("time_constant");
  const double a = table.positive("yasuda_exponent", 2);
  const double n = table.positive("index");
  const double largest = table.positive("largest_shear_rate", 10);
  const double mu = nu * density;
  return {fmt::format("carreau-yasuda n={}", n), mpm::CarreauYasuda{mu, ratio * mu, lambda, a, n, largest},
          reference::CarreauYasudaCurve{nu, ratio * nu, lambda, a, n}};
}

using Reader = Model (*)(TomlTable&, double, double);
const std::vector<std::pair<std::string, Reader>> readers = {
    {"newtonian", read_newtonian},
    {"cross", read_cross},
    {"power-law", read_power_law},
    {"carreau-yasuda", read_carreau_yasuda},
};

Reader reader_of(TomlTable& table) {
  const std::string model = table.text("model", "newtonian");
  std::string known;
  for (const auto& [name, read] : readers) {
    if (name == model) return read;
    known += (known.empty() ? "" : ", ") + name;
  }
  table.fail("model", "'" + model + "' is not known; choose one of: " + known);
}

}  // namespace

FluidConfig read_fluid(TomlTable table) {
  FluidConfig fluid;
  const Reader read_model = reader_of(table);
  fluid.kinematic_viscosity = table.positive("kinematic_viscosity");
  fluid.solver.density = table.positive("density", 1000);
  fluid.solver.pressure = table.flag("pressure", true);
  try {
    const Model model = read_model(table, fluid.kinematic_viscosity, fluid.solver.density);
    fluid.label = model.label;
    fluid.solver.rheology = model.rheology;
    fluid.curve = model.curve;
  } catch (const std::invalid_argument& error) {
    table.fail("model", error.what());
  }
  table.accept("bulk_modulus");
  table.refuse_unknown_keys();  // before the next line: a misspelt `pressure` would be told as a missing
                                // modulus
  if (fluid.solver.pressure) fluid.solver.bulk_modulus = table.positive("bulk_modulus");
  return fluid;
}

}  // namespace verification
