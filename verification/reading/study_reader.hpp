#pragma once

#include <filesystem>
#include <vector>

#include "verification/study/study.hpp"

namespace verification {

/// Reads one study. Its name is the file's stem. Refused with file and key (ConfigError): an unknown key, a
/// check without a reason, a study without a check, a scene that the solver could not run.
Study read_study(const std::filesystem::path& file);

/// Every *.toml of a directory, by name. Throws ConfigError when there is none.
std::vector<Study> read_studies(const std::filesystem::path& directory);

}  // namespace verification
