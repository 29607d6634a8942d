#pragma once

#include <filesystem>

#include "reports/files/atomic_file.hpp"
#include "reports/records/records.hpp"

namespace reports {

/// time-steps.csv and pilots.csv, which are there only where a scene says dt = "auto". @throws IoError
void read_time_steps(const std::filesystem::path& dir, Results& results);
void write_time_steps(const std::filesystem::path& dir, const Results& results, Durability durability);

}  // namespace reports
