#pragma once

#include "verification/config/toml_table.hpp"
#include "verification/study/study.hpp"

namespace verification {

/// Reads [solver] of a study file: name, command (a list, or a text that is split as a shell would, without
/// one) or results (a directory with {run}), version, options, inputs, cores, working_directory (default: the
/// study's), environment, timeout, delivers, locations, points_across with points_reason. Throws
/// ConfigError, also for a placeholder that is not known.
ForeignSolver read_solver(TomlTable table, const std::filesystem::path& study_file);

/// Gives a planned run its solver: the scene is read for it, and handed_scene() is what it gets.
/// Throws ConfigError for a {dt} that the scene does not give.
void give_to(PlannedRun& planned, const std::shared_ptr<const ForeignSolver>& solver, const TomlTable& scene);

/// Refuses checks and figures that read what the study's solver does not deliver.
void require_delivered(const TomlTable& root, const Study& study);

}  // namespace verification
