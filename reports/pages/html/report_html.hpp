#pragma once

#include <filesystem>
#include <string>

#include "reports/pages/sections/study.hpp"
#include "reports/records/report_data.hpp"

namespace reports {

/// The report as one self-contained page: first screen (verdict, scope, headline numbers, changes), chapters
/// by topic with their studies, provenance. Drawn figures are read from <dir>/figures. On paper: a title page
/// with provenance and contents, and nothing folded that a reviewer would miss. @throws IoError if a figure
/// cannot be read.
std::string html_report(const std::filesystem::path& dir, const ReportData& data,
                        Medium medium = Medium::Screen);

}  // namespace reports
