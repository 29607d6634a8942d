#pragma once

#include <string>

#include "reports/records/records.hpp"

namespace reports {

/// JUnit XML: a suite for each study, a test case for each check; a check that does not hold is a failure
/// with observed value, bounds and reason. A suite's time is the sum of its runs' wall times where they are
/// known.
std::string junit_report(const Results& results);

/// Text for XML attributes and content: markup escaped, characters that XML forbids and broken UTF-8 replaced
/// by '?'. HTML can use it too.
std::string xml_text(const std::string& text);

}  // namespace reports
