#pragma once

#include <string>

#include "reports/pages/html/figure.hpp"
#include "reports/records/chapters.hpp"

namespace reports {

/// Comparisons of a chapter's studies with measurements: for every table of data what it is and how it fares
/// as a whole, then each value with E +- k u_val, the three parts of u_val as a bar, and the verdict; at the
/// end what the verdicts do not cover, and computed against measured over all studies. "" where nothing was
/// compared.
std::string html_validation(const Results& results, const Chapter& chapter, PageFigures& figures);

}  // namespace reports
