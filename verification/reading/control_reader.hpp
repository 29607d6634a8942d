#pragma once

#include "verification/study/study.hpp"

namespace verification {

/// Reads [control] of a study whose checks have been read. Throws ConfigError.
ControlSpec read_control(TomlTable table, const Study& study, const std::filesystem::path& file);

/// What a suite runs of a study with a [control]: the control alone, which runs the rest by itself.
void leave_to_control(Study& study);

}  // namespace verification
