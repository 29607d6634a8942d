#pragma once

#include <string>

#include "reports/pages/html/figure.hpp"
#include "reports/records/chapters.hpp"

namespace reports {

/// What a reader sees first: verdict, scope, headline numbers with their figures, what changed since the last
/// run; then the failures, if any, and the warnings.
std::string first_screen(const ReportData& data, const std::vector<Chapter>& chapters,
                         const PageFigures& figures);

/// The column beside the page: search, filters, chapters with their studies.
std::string side_column(const ReportData& data, const std::vector<Chapter>& chapters);

/// A fragment identifier made from a chapter's title.
std::string chapter_anchor(const Chapter& chapter);

/// What made the results, as a table.
std::string provenance_table(const std::optional<Provenance>& provenance);

}  // namespace reports
