#pragma once

#include <string>

#include "reports/pages/html/figure.hpp"
#include "reports/pages/sections/study.hpp"
#include "reports/records/chapters.hpp"

namespace reports {

/// One chapter: paragraph, best figure, table of studies, what its records add (claims, scoreboard, order
/// matrix, stability limits, cheapest runs), and its studies. A record of no study goes with `last` chapters.
std::string html_chapter(const ReportData& data, const Chapter& chapter, PageFigures& figures, Medium medium);

/// Statements of others as a judge's notes: statement, verdict, the number that decides; the rest folded.
std::string html_claims(const Results& results, const Chapter& chapter);

}  // namespace reports
