#pragma once

#include <string>

#include "reports/records/report_data.hpp"

namespace reports {

/// The report as Markdown, short enough for a CI summary: verdict on the first line, failures next, then
/// checks, orders, diverged runs, warnings and where it all came from.
std::string markdown_report(const ReportData& data);

/// Text with everything that Markdown or HTML would interpret made literal; one line, fit for a table cell.
std::string markdown_text(const std::string& text);

}  // namespace reports
