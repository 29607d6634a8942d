#pragma once

#include <filesystem>
#include <string>

#include "verification/study/study.hpp"

namespace verification {

/// Reads one study. Its name is the file's stem. Refused with file and key (ConfigError): an unknown key, a
/// check without a reason, a study without a check, a scene that the solver could not run.
/// `topic` is the chapter of the report that it belongs to unless it names one.
Study read_study(const std::filesystem::path& file, const std::string& topic = "");

/// Throws ConfigError where two runs, of one study or of two, have the same name and so the same files.
void require_distinct_runs(const std::vector<Study>& studies);

}  // namespace verification
