#pragma once

#include <filesystem>

#include "reports/files/atomic_file.hpp"
#include "reports/records/records.hpp"

namespace reports {

/// validation.csv, validation-joint.csv and validation-bias.csv of a result directory; all must be there.
/// @throws IoError
void read_validation(const std::filesystem::path& dir, Results& results);
void write_validation(const std::filesystem::path& dir, const Results& results, Durability durability);

}  // namespace reports
