#pragma once

#include <filesystem>

#include "verification/config/toml_table.hpp"
#include "verification/study/study.hpp"

namespace verification {

/// Reads [validation] before the runs are planned, for its inputs need runs of their own; `file` is the
/// study's: tables are named relative to it. Throws ConfigError.
ValidationSpec read_validation(TomlTable table, const std::filesystem::path& file, const Study& study);

/// Scenes of the runs that vary a variant's inputs, in the order of input_variants(). Throws ConfigError for
/// an input that is no number of the scene.
std::vector<TomlTable> input_scenes(const ValidationSpec& spec, const TomlTable& scene);

/// Once the runs are planned: refuses variants that are none, rows at times that are no output, and places
/// outside of the scene (ConfigError with file, row and remedy).
void require_places(const Study& study);

}  // namespace verification
