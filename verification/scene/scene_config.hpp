#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/incompressible/incompressible_scheme.hpp"
#include "solver/scene/scene.hpp"
#include "solver/sph/sph_scheme.hpp"
#include "solver/step/time_step.hpp"
#include "verification/config/toml_table.hpp"
#include "verification/scene/flow_reader.hpp"

namespace verification {

/// time.dt = "auto": the step follows from errors that pilot runs measure (runs/pilot/).
struct AutoStep {
  double fraction = 0.1;  ///< of the error in space that the error in time may be: time.time_error_fraction
  double stable = 0;      ///< longest step that the limits allow [s]; infinite where none bounds it
};

/// One simulation as the user states it: the tables scene, fluid, discretisation, scheme and time of a TOML
/// file.
struct SceneConfig {
  std::string toml;       ///< text that reproduces it
  std::string resolved;   ///< the same with every default written out
  std::string flow_name;  ///< scene.flow
  std::shared_ptr<const Flow> flow;
  FluidConfig fluid;
  Discretisation discretisation;
  mpm::Scheme scheme;                 ///< of the material point method
  std::optional<mpm::SphScheme> sph;  ///< scheme.method = "sph": simulated by SPH instead
  /// fluid.pressure = "incompressible": simulated by the incompressible material point method instead
  std::optional<mpm::IncompressibleScheme> incompressible;
  mpm::TimeStepRule time_step;
  std::optional<AutoStep> auto_step;  ///< then time_step, and all that follows from it, is for the time being
  double start = 0;  ///< time at which the run starts, from the exact solution if not from rest [s]
  std::vector<double> outputs;               ///< output times, increasing [s]
  std::vector<double> more_reference_times;  ///< time.reference_times [s]
  int history_samples = 0;                   ///< points in the history, evenly spread over the run
  mpm::Scene scene;                          ///< the solver's scene that follows from all this
  std::vector<mpm::Segment> segments;
  bool dt_given = true;  ///< false only of somebody else's scene: segments then are the spans of outputs

  /// Times at which the reference is wanted [s], increasing: start, outputs, and those asked for besides, so
  /// that scenes with different outputs can share one computed reference.
  [[nodiscard]] std::vector<double> reference_times() const;
  [[nodiscard]] long particles() const;
  [[nodiscard]] long steps() const;
  /// Particles times steps: what the run costs on any machine.
  [[nodiscard]] double particle_steps() const;
  /// Cell size in the direction across [m].
  [[nodiscard]] double cell_size() const { return flow->length() / discretisation.cells; }
};

/// The tables that make up a scene, in reading order.
const std::vector<std::string>& scene_tables();

/// Whose solver a scene is for. Somebody else's needs no bulk_modulus (its fluid may be incompressible) and
/// no time step (it may choose its own).
enum class SceneFor { Ours, Theirs };

/// Reads a scene and refuses what the solver could not run. Tables that the protocol adds to a scene that is
/// handed on ([protocol], [coordinates], [solver]) are passed over. Throws ConfigError.
SceneConfig read_scene_config(TomlTable root, SceneFor whose = SceneFor::Ours);

}  // namespace verification
