#pragma once

#include <string>
#include <vector>

#include "reports/pages/html/figure.hpp"
#include "reports/records/report_data.hpp"

namespace reports {

/// What a page is for: folded details on a screen; on paper figures and numbers, without the long tables.
enum class Medium { Screen, Paper };

/// The section of one study: claim, verdict, the number nearest to its bound; folded on a screen: figures,
/// checks, errors with rates, orders, runs.
std::string html_study(const ReportData& data, const StudyRecord& study, const std::string& topic,
                       PageFigures& figures, Medium medium);

/// A table of checks with verdict, observed value, bounds and reason. Neighbours with the same bounds and
/// reason share a heading.
std::string html_checks(const std::vector<const CheckRecord*>& checks, bool with_study);

/// The runs of a study that a reader may want: every one that did not complete, the others as far as there
/// are few.
std::string html_runs(const Results& results, const std::string& study);

}  // namespace reports
