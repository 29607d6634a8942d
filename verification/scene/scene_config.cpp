#include "verification/scene/scene_config.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/incompressible/make_incompressible_solver.hpp"
#include "solver/scene/seeding.hpp"
#include "solver/sph/stable_sph_step.hpp"
#include "verification/config/config_error.hpp"
#include "verification/scene/scene_cost.hpp"
#include "verification/scene/time_step_reader.hpp"

namespace verification {
namespace {

/// Flows whose solution holds the speed of sound.
const std::vector<std::string> compressible_flows = {"acoustic-wave", "tait-column", "uniform-dilatation"};

/// `per_cell`: particles a cell along an axis, where nothing is said.
Discretisation read_discretisation(TomlTable& table, int per_cell) {
  Discretisation d;
  d.cells = table.integer("cells");
  if (d.cells < 1) table.fail("cells", "must be at least 1");
  d.cells_along = table.integer("cells_along", 1);
  if (d.cells_along < 1) table.fail("cells_along", "must be at least 1");
  d.particles_across = table.integer("particles_across", per_cell);
  if (d.particles_across < 1) table.fail("particles_across", "must be at least 1");
  d.particles_along = table.integer("particles_along", per_cell);
  if (d.particles_along < 1) table.fail("particles_along", "must be at least 1");
  return d;
}

template <class Named>
auto read_named(TomlTable& table, const std::string& key, const std::string& absent, Named&& named) {
  const std::string text = table.text(key, absent);
  try {
    return named(text);
  } catch (const mpm::SceneError& error) {
    table.fail(key, error.what());
  }
}

/// Rows across the flow by the rule, even spacing along it: rows of a shear flow slide along themselves, and
/// equal spacing keeps the nodal mass constant.
mpm::Seeding read_seeding(TomlTable& table, int across) {
  mpm::Seeding seeding;
  seeding.rule[static_cast<std::size_t>(across)] = read_named(table, "seeding", "even", mpm::seeding_named);
  seeding.displacement = table.number("displacement", 0);
  if (!(seeding.displacement >= 0 && seeding.displacement <= 0.5))
    table.fail("displacement", "must lie in [0, 0.5] of the particle spacing");
  const int seed = table.integer("seed", 1);
  if (seed < 0) table.fail("seed", "must not be negative");
  seeding.seed = static_cast<unsigned>(seed);
  return seeding;
}

/// Keys of [scheme] that the other method reads.
void refuse_keys_of_another_method(TomlTable& table, const std::vector<std::string>& keys,
                                   const std::string& theirs, const std::string& ours) {
  for (const std::string& key : keys)
    if (table.has(key)) table.fail(key, "is a key of " + theirs + ", this scheme is " + ours + ": remove it");
}

const std::vector<std::string> keys_of_mpm = {"basis",       "transfer",     "flip_fraction",
                                              "reset_every", "reset_strain", "dilatation"};
const std::vector<std::string> keys_of_sph = {"kernel", "density", "wall", "smoothing", "wall_limit"};
const std::vector<std::string> keys_of_incompressible = {"degree", "remap_every", "regularisation"};
const std::string incompressible_method = "the incompressible method (fluid.pressure = \"incompressible\")";

mpm::SphScheme read_sph(TomlTable table) {
  mpm::SphScheme sph;
  refuse_keys_of_another_method(table, keys_of_mpm, "method = \"mpm\"", "sph");
  refuse_keys_of_another_method(table, {"stepping"}, "method = \"mpm\"", "sph");
  refuse_keys_of_another_method(table, keys_of_incompressible, incompressible_method, "sph");
  sph.kernel = read_named(table, "kernel", "quintic", mpm::sph_kernel_named);
  sph.density = read_named(table, "density", "continuity", mpm::sph_density_named);
  sph.wall = read_named(table, "wall", "mirror", mpm::sph_wall_named);
  if (table.has("smoothing")) sph.smoothing = table.positive("smoothing");
  if (sph.smoothing > 0 && !(sph.smoothing >= 0.7 && sph.smoothing <= 5))
    table.fail("smoothing", "must lie in [0.7, 5]: the smoothing length over the spacing of the particles");
  if (table.has("wall_limit")) {
    sph.wall_limit = table.number("wall_limit");
    if (sph.wall != mpm::SphScheme::Wall::Morris) table.fail("wall_limit", "is for wall = \"morris\" only");
    if (!(sph.wall_limit >= 1)) table.fail("wall_limit", "must be at least 1");
  }
  table.refuse_unknown_keys();
  return sph;
}

mpm::Scheme read_scheme(TomlTable table) {
  mpm::Scheme scheme;
  refuse_keys_of_another_method(table, keys_of_sph, "method = \"sph\"", "mpm");
  refuse_keys_of_another_method(table, keys_of_incompressible, incompressible_method, "weakly compressible");
  scheme.basis = read_named(table, "basis", "linear", mpm::basis_named);
  scheme.transfer = read_named(table, "transfer", "flip", mpm::transfer_named);
  scheme.stepping = read_named(table, "stepping", "usf", mpm::stepping_named);
  scheme.dilatation = read_named(table, "dilatation", "particle", mpm::dilatation_named);
  if (scheme.transfer == mpm::Scheme::Transfer::FlipBlend) {
    scheme.flip_fraction = table.number("flip_fraction", scheme.flip_fraction);
    if (!(scheme.flip_fraction >= 0 && scheme.flip_fraction <= 1))
      table.fail("flip_fraction", "must lie in [0, 1]");
  }
  scheme.reset_every = table.integer("reset_every", 0);
  if (scheme.reset_every < 0)
    table.fail("reset_every", "must not be negative: steps between resets, 0 for none");
  if (table.has("reset_strain")) scheme.reset_strain = table.positive("reset_strain");
  table.refuse_unknown_keys();
  try {
    scheme.validate();
  } catch (const mpm::SceneError& error) {
    table.fail("dilatation", error.what());
  }
  return scheme;
}

mpm::IncompressibleScheme read_incompressible(TomlTable table) {
  mpm::IncompressibleScheme scheme;
  refuse_keys_of_another_method(table, keys_of_mpm, "the weakly compressible method", "incompressible");
  refuse_keys_of_another_method(table, keys_of_sph, "method = \"sph\"", "incompressible");
  scheme.degree = table.integer("degree", scheme.degree);
  scheme.stepping = read_named(table, "stepping", "midpoint", mpm::incompressible_stepping_named);
  scheme.remap_every = table.integer("remap_every", scheme.remap_every);
  scheme.regularisation = table.positive("regularisation", scheme.regularisation);
  table.refuse_unknown_keys();
  try {
    scheme.validate();
  } catch (const mpm::SceneError& error) {
    table.fail("degree", error.what());
  }
  return scheme;
}

std::vector<double> read_outputs(TomlTable& table) {
  std::vector<double> outputs;
  if (table.has("outputs")) outputs = table.numbers("outputs");
  double last = 0;
  for (const double t : outputs) {
    if (!(t > last)) table.fail("outputs", "must be positive and increase");
    last = t;
  }
  if (table.has("end")) {
    const double end = table.positive("end");
    if (end < last) table.fail("end", "must not lie before the last output");
    if (end > last) outputs.push_back(end);
  }
  if (outputs.empty()) table.fail("end", "is missing; give the end time or a list of outputs [s]");
  return outputs;
}

}  // namespace

const std::vector<std::string>& scene_tables() {
  static const std::vector<std::string> tables = {"scene", "fluid", "discretisation", "scheme", "time"};
  return tables;
}

std::vector<double> SceneConfig::reference_times() const {
  std::vector<double> times = outputs;
  if (start > 0) times.push_back(start);
  times.insert(times.end(), more_reference_times.begin(), more_reference_times.end());
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// No overflow: require_memory() has refused what would.
long SceneConfig::particles() const {
  if (scene.free_surface) return static_cast<long>(mpm::seed_particles(scene).size());
  return static_cast<long>(scene.cells[0]) * scene.cells[1] * scene.particles_per_cell[0] *
         scene.particles_per_cell[1];
}

long SceneConfig::steps() const {
  long sum = 0;
  for (const mpm::Segment& segment : segments) sum += segment.steps;
  return sum;
}

double SceneConfig::particle_steps() const {
  return static_cast<double>(particles()) * static_cast<double>(steps());
}

SceneConfig read_scene_config(TomlTable root, SceneFor whose) {
  SceneConfig config;
  const bool theirs = whose == SceneFor::Theirs;
  for (const char* table : {"protocol", "coordinates", "solver"}) root.accept(table);
  root.note_defaults();
  config.toml = root.restricted_to(scene_tables()).print();
  TomlTable scheme = root.table("scheme");
  const std::string method = scheme.text("method", "mpm");
  if (method != "mpm" && method != "sph")
    scheme.fail("method", "'" + method + "' is not known; choose one of: mpm, sph");
  TomlTable fluid = root.table("fluid");
  const bool incompressible = is_incompressible(fluid);
  const bool is_sph = method == "sph";  // without a grid: a cell is a particle, where nothing is said
  if (is_sph && incompressible)
    scheme.fail(
        "method",
        "\"sph\" is weakly compressible: give fluid.bulk_modulus instead of pressure = \"incompressible\"");
  if (is_sph)
    config.sph = read_sph(scheme);
  else if (incompressible)
    config.incompressible = read_incompressible(scheme);
  else
    config.scheme = read_scheme(scheme);
  TomlTable discretisation = root.table("discretisation");
  config.discretisation = read_discretisation(discretisation, is_sph ? 1 : 2);
  config.fluid = read_fluid(fluid, config.discretisation.cells, theirs);
  TomlTable scene = root.table("scene");
  config.flow_name = scene.text("flow");
  config.flow = read_flow(scene, config.fluid);
  if ((config.fluid.without_modulus || incompressible) &&
      std::ranges::count(compressible_flows, config.flow_name) > 0)
    fluid.fail_missing("bulk_modulus", "the solution of this flow depends on it");
  const mpm::Seeding seeding = read_seeding(discretisation, config.flow->across());
  if (is_sph && std::ranges::count(seeding.rule, mpm::Seeding::Rule::Gauss) > 0)
    discretisation.fail("seeding", "must be \"even\" for method = \"sph\": its particles have equal mass");
  discretisation.refuse_unknown_keys();
  TomlTable time = root.table("time");
  config.start = time.has("start") ? time.positive("start") : 0;
  if (config.start > 0 && !config.flow->has_exact())
    time.fail("start", "needs a flow with an exact solution");
  config.outputs = read_outputs(time);
  if (config.outputs.front() <= config.start) time.fail("outputs", "must lie beyond time.start");
  if (config.outputs.back() >= config.flow->latest())
    time.fail("end", "must lie before the end of the solution: the flow collapses at its 1/rate");
  if (time.has("reference_times")) config.more_reference_times = time.numbers("reference_times");
  for (const double t : config.more_reference_times)
    if (!(t > 0)) time.fail("reference_times", "must be positive");
  config.history_samples = time.integer("history_samples", 100);
  if (config.history_samples < 1) time.fail("history_samples", "must be at least 1");
  try {
    config.scene = config.flow->scene(config.discretisation);
    config.scene.seeding = seeding;
    config.scene.start = config.start;
    config.scene.validate();
    mpm::check_together(config.scene, config.scheme);
    if (is_sph) mpm::require_sph_fits(*config.sph, config.scene);
    if (incompressible && !theirs) mpm::require_incompressible_fits(*config.incompressible, config.scene);
  } catch (const std::invalid_argument& error) {  // a SceneError, or what a reference refuses
    root.fail("scene", error.what());
  }
  require_memory(root, config);
  try {
    static_cast<void>(config.particles());  // with a free surface they are counted: there may be none
  } catch (const mpm::SceneError& error) {
    root.fail("scene.fluid_region", error.what());
  }
  if (config.start > 0 && config.scene.initial_density &&
      !config.flow->exact({config.start})->density(Vec2::Zero(), config.start))
    time.fail("start", "is for flows whose density is known at any time: this one starts at t = 0 only");
  config.dt_given = !theirs || time.has("dt") || time.has("cfl_acoustic") || time.has("cfl_viscous");
  if (config.dt_given)
    read_time_step(time, config);
  else
    config.time_step.dt = config.outputs.back() - config.start;
  time.refuse_unknown_keys();
  root.refuse_unknown_keys();
  try {
    config.segments = mpm::plan_segments(config.time_step, config.scene, config.outputs, config.start);
  } catch (const mpm::SceneError& error) {
    root.fail(config.time_step.dt > 0 ? "time.dt" : "scene", error.what());
  }
  require_steps(root, config);
  TomlTable resolved = root.with_defaults().restricted_to(scene_tables());
  resolved.set("time.outputs", config.outputs);
  config.resolved = resolved.print();
  return config;
}

}  // namespace verification
