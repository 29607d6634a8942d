#pragma once

#include <string>
#include <vector>

#include "reports/records/records.hpp"

namespace reports {

/// The order matrix as a section: a row a scheme, a column a flow, axis and location; "" without records.
std::string html_matrix(const std::vector<MatrixRecord>& matrix);

/// The same for Markdown.
std::string markdown_matrix(const std::vector<MatrixRecord>& matrix);

}  // namespace reports
