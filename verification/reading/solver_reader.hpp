#pragma once

#include "verification/config/toml_table.hpp"
#include "verification/study/study.hpp"

namespace verification {

/// Reads [solver] of a study file: name, command (a list, or a text that is split as a shell would, without
/// one), working_directory (default: the study's), environment, timeout, delivers, locations, points_across
/// with points_reason. Throws ConfigError, also for a placeholder that is not known.
ForeignSolver read_solver(TomlTable table, const std::filesystem::path& study_file);

/// Refuses checks and figures that read what the study's solver does not deliver.
void require_delivered(const TomlTable& root, const Study& study);

}  // namespace verification
