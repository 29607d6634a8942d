#include "verification/scene/time_step_reader.hpp"

#include <cmath>
#include <limits>

#include "solver/sph/stable_sph_step.hpp"
#include "solver/step/stable_step.hpp"
#include "verification/config/config_error.hpp"
#include "verification/scene/scene_cost.hpp"

namespace verification {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

bool has_implicit_viscosity(const SceneConfig& config) {
  return !config.sph && !config.incompressible &&
         std::isinf(mpm::stable_step(config.scheme, mpm::fewest_particles_per_cell(config.scene)).viscous);
}

/// The step that limits, given or known, allow; where nothing bounds it, one by what accuracy asks for as a
/// rule.
mpm::TimeStepRule rule_of_limits(TomlTable& table, const SceneConfig& config) {
  const mpm::Scene& scene = config.scene;
  mpm::TimeStepRule rule;
  if (table.has("cfl_acoustic") && table.has("cfl_viscous")) {
    rule.cfl_acoustic = table.positive("cfl_acoustic");
    rule.cfl_viscous = table.positive("cfl_viscous");
    return rule;
  }
  if (config.incompressible) {
    for (const char* key : {"cfl_acoustic", "cfl_viscous"})
      if (table.has(key))
        table.fail(key,
                   "has no meaning for an incompressible fluid, whose step neither sound nor viscosity "
                   "bounds: give dt");
    // Nothing bounds the step but accuracy: a particle crosses two fifths of a cell.
    rule.dt = 0.4 * scene.smallest_cell_size() / config.flow->velocity_scale();
    return rule;
  }
  try {
    rule = config.sph ? mpm::sph_time_step(*config.sph, config.scene)
                      : mpm::automatic_time_step(config.scheme, config.scene);
  } catch (const mpm::SceneError& error) {
    table.fail("dt", error.what());
  }
  if (has_implicit_viscosity(config)) {
    // Implicit viscosity: the explicit limit at the largest viscosity, which a power law has at its
    // shear-rate floor, says nothing. Accuracy does.
    const double h = scene.smallest_cell_size();
    rule.cfl_viscous = accurate_implicit_step(config) * scene.fluid.largest_kinematic_viscosity() / (h * h);
  }
  rule.cfl_acoustic = table.positive("cfl_acoustic", rule.cfl_acoustic);
  rule.cfl_viscous = table.positive("cfl_viscous", rule.cfl_viscous);
  return rule;
}

/// What bounds the step but its error [s].
double stable_bound(TomlTable& table, const SceneConfig& config, mpm::TimeStepRule rule) {
  if (config.incompressible) return unbounded;
  const bool viscous = table.has("cfl_viscous") || !has_implicit_viscosity(config);
  if (!viscous) {
    const double sound = config.scene.fluid.sound_speed();
    return sound > 0 ? rule.cfl_acoustic * config.scene.smallest_cell_size() / sound : unbounded;
  }
  return mpm::nominal_time_step(rule, config.scene);
}

}  // namespace

void read_time_step(TomlTable& table, SceneConfig& config) {
  if (!table.is_text("dt")) {
    if (table.has("time_error_fraction"))
      table.fail("time_error_fraction", "is for dt = \"auto\": give that, or remove this");
    if (!table.has("dt")) {
      config.time_step = rule_of_limits(table, config);
      return;
    }
    config.time_step.dt = table.positive("dt");
    for (const char* key : {"cfl_acoustic", "cfl_viscous"})
      if (table.has(key)) table.fail(key, "cannot stand beside dt: give either a step or its limits");
    return;
  }
  if (table.text("dt") != "auto") table.fail("dt", "must be a number of seconds, or \"auto\"");
  AutoStep chosen;
  chosen.fraction = table.positive("time_error_fraction", chosen.fraction);
  if (chosen.fraction > 1)
    table.fail("time_error_fraction", "must be at most 1: the error in time as a part of that in space");
  config.time_step = rule_of_limits(table, config);
  try {
    chosen.stable = stable_bound(table, config, config.time_step);
  } catch (const mpm::SceneError& error) {
    table.fail("dt", error.what());
  }
  config.auto_step = chosen;
}

SceneConfig with_step(const SceneConfig& scene, double dt) {
  TomlTable text = TomlTable::from_text(scene.toml, "scene");
  for (const char* key : {"time.time_error_fraction", "time.cfl_acoustic", "time.cfl_viscous"})
    text.erase(key);
  text.set("time.dt", dt);
  return read_scene_config(text);
}

}  // namespace verification
