#pragma once

#include <string>
#include <vector>

#include "reports/records/records.hpp"

namespace reports {

/// The stability scoreboard as a section: a row a scheme, grouped by basis, a column a hard case; below it
/// each case's thresholds and the reasons of what was expected. "" without records.
std::string html_scoreboard(const std::vector<ScoreRecord>& scores);

}  // namespace reports
