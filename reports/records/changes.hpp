#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/records/records.hpp"

namespace reports {

/// The check of a suite that was stopped, as files of numbers name it: "study, check".
inline constexpr const char* stopped_suite = "suite, runs that ended";

/// The row that names the earlier run instead of a number.
bool is_the_earlier_run(const ChangeRecord& change);
/// The row for an earlier run that `name` describes.
ChangeRecord the_earlier_run(const std::string& name);

/// One sentence: "nothing is different from the run of ...", "2 worse, 1 better, ...".
std::string changes_line(const std::optional<std::vector<ChangeRecord>>& changes);

}  // namespace reports
