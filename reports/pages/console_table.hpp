#pragma once

#include <string>
#include <vector>

#include "reports/records/records.hpp"

namespace reports {

/// The checks as a table for a terminal, at most 110 columns wide: one line for each that holds, then those
/// that do not with observed value, bounds and reason, then the count. `colour` adds ANSI colours; the caller
/// knows whether the output is a terminal and whether NO_COLOR is set. `unlisted` checks, which hold too, are
/// counted without a line.
std::string console_table(const std::vector<CheckRecord>& checks, bool colour, std::size_t unlisted = 0);

}  // namespace reports
