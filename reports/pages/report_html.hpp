#pragma once

#include <filesystem>
#include <string>

#include "reports/records/report_data.hpp"

namespace reports {

/// The report as one self-contained page: verdict, failures, contents, a section for each study, runs,
/// timing, provenance. Drawn figures are read from <dir>/figures. @throws IoError if one of them cannot be
/// read.
std::string html_report(const std::filesystem::path& dir, const ReportData& data);

}  // namespace reports
