#pragma once

#include <filesystem>

#include "verification/config/toml_table.hpp"
#include "verification/study/study.hpp"

namespace verification {

/// Reads compare_with and [compare_table] of a study file: what its runs are compared with, and the table
/// itself where it is one (CSV with t,x,y,u,v beside the study). Throws ConfigError.
void read_comparison(TomlTable& root, const std::filesystem::path& study_file, Study& study);

/// Refuses, once the runs are planned, what their flows do not offer; and, of a table, times that it does not
/// hold. Throws ConfigError.
void require_comparable(const TomlTable& root, const Study& study);

/// Refuses checks that a table's own uncertainty leaves open, and ladders that cannot be compared with their
/// finest level. Throws ConfigError.
void require_decidable(const TomlTable& root, const Study& study);

/// Refuses a scene with dt = "auto" in a study, with this ladder, that has no error to choose the step by.
void require_step_by_error(const Study& study, TomlTable scene, const Ladder& ladder, bool foreign);

}  // namespace verification
