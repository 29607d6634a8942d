#pragma once

#include <string>
#include <vector>

#include "reports/records/records.hpp"

namespace reports {

/// Stability limits as a section: a row a scheme, a column a kind of waves, motion and ray; "" without
/// records.
std::string html_stability(const std::vector<StabilityRecord>& limits);

/// The same for Markdown.
std::string markdown_stability(const std::vector<StabilityRecord>& limits);

}  // namespace reports
