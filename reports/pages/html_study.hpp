#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/records/report_data.hpp"

namespace reports {

/// The section of one study: claim, checks, figures, errors with rates, orders. Figures are read from
/// <dir>/figures and become part of the page.
std::string html_study(const std::filesystem::path& dir, const ReportData& data, const StudyRecord& study);

/// A table of checks with verdict, observed value, bounds and reason.
std::string html_checks(const std::vector<const CheckRecord*>& checks, bool with_study);

}  // namespace reports
