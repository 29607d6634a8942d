#pragma once

#include <string>

#include "reports/records/report_data.hpp"

namespace reports {

/// Bytes that a summary never exceeds, whatever went wrong: what CI hosts show of a step, and what people
/// read.
constexpr std::size_t summary_limit = 60'000;

/// The report as a CI step shows it: verdict, failures first, what changed, a table of topics, headline
/// numbers, and where the page is. GitHub-flavoured Markdown.
std::string markdown_summary(const ReportData& data);

}  // namespace reports
