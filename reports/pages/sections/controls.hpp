#pragma once

#include <string>
#include <vector>

#include "reports/records/records.hpp"

namespace reports {

/// The table of negative controls: what was planted, what must be red for it, what was, and whether the
/// program said so everywhere. Their failures are what is wanted and count nowhere else. "" without any.
std::string html_controls(const std::vector<ControlRecord>& controls);
std::string markdown_controls(const std::vector<ControlRecord>& controls);

/// "Negative controls: 14 of 14 planted faults were seen"; "" without any.
std::string controls_line(const std::vector<ControlRecord>& controls);

}  // namespace reports
