#pragma once

#include <string>

#include "reports/records/records.hpp"

namespace reports {

/// The steps that were chosen for the runs of a study whose scenes say dt = "auto", and from which numbers;
/// "" where there are none.
std::string html_time_steps(const Results& results, const std::string& study);
/// The same for all studies.
std::string markdown_time_steps(const Results& results);

}  // namespace reports
