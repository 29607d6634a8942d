#include "reports/pages/sections/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/pages/html/page.hpp"
#include "reports/pages/sections/crossed_table.hpp"
#include "reports/records/report_data.hpp"

namespace reports {
namespace {

std::string row_of(const MatrixRecord& r) {
  return r.basis + ", " + r.transfer + ", " + r.stepping;
}
std::string column_of(const MatrixRecord& r) {
  return r.scene + ", " + r.axis + ", " + r.location;
}

CrossedTable<MatrixRecord> crossed(const std::vector<MatrixRecord>& matrix) {
  CrossedTable<MatrixRecord> table;
  for (const MatrixRecord& record : matrix) table.add(row_of(record), column_of(record), record);
  return table;
}

std::string interval(const MatrixRecord& r) {
  return std::isfinite(r.ci_lower) ? fmt::format(" [{:.2f}, {:.2f}]", r.ci_lower, r.ci_upper) : "";
}

std::string theory(const MatrixRecord& r) {
  return std::isnan(r.theoretical) ? "none" : number(r.theoretical, 3);
}

}  // namespace

std::string html_matrix(const std::vector<MatrixRecord>& matrix) {
  if (matrix.empty()) return "";
  const CrossedTable<MatrixRecord> table = crossed(matrix);
  std::string head = "<th>basis, transfer, stepping</th>";
  for (const std::string& column : table.columns) head += "<th>" + html_text(column) + "</th>";
  std::string rows;
  std::vector<std::string> reasons;
  for (const std::string& row : table.rows) {
    rows += "<tr><td class=\"w\">" + html_text(row) + "</td>";
    for (const std::string& column : table.columns) {
      const auto cell = table.cells.find({row, column});
      if (cell == table.cells.end()) {
        rows += "<td class=\"faint\">not run</td>";
        continue;
      }
      const MatrixRecord& r = *cell->second;
      std::string mark;
      if (!r.reason.empty()) {
        const auto known = std::find(reasons.begin(), reasons.end(), r.reason);
        const auto index = known - reasons.begin();
        if (known == reasons.end()) reasons.push_back(r.reason);
        mark = fmt::format(" <sup>{}</sup>", index + 1);
      }
      const char* shade = r.verdict == "pass" ? "pass" : r.verdict == "fail" ? "fail" : "faint";
      rows += fmt::format(
          "<td class=\"n\"><span class=\"{}\">{}</span> <b>{:.2f}</b>{}<br>theory {}{}; to {}</td>", shade,
          html_text(r.verdict), r.observed, interval(r), theory(r), mark, number(r.smallest_error, 2));
    }
    rows += "</tr>\n";
  }
  std::string notes;
  for (std::size_t i = 0; i < reasons.size(); ++i)
    notes += fmt::format("<p class=\"faint\"><sup>{}</sup> {}.</p>\n", i + 1, html_text(reasons[i]));
  return "<section>\n<h3 id=\"matrix\">Order matrix</h3>\n"
         "<p class=\"faint\">Each cell: verdict, observed L2 order with its 95 % interval, the order that "
         "theory gives, and "
         "the smallest relative error reached (time: difference of successive dt on one mesh).</p>\n" +
         html_table(head, rows) + notes + "</section>\n";
}

std::string markdown_matrix(const std::vector<MatrixRecord>& matrix) {
  if (matrix.empty()) return "";
  const CrossedTable<MatrixRecord> table = crossed(matrix);
  std::string text =
      "\n## Order matrix\n\nObserved L2 order (theory); see report.html for intervals and errors.\n\n| "
      "scheme |";
  std::string rule = "\n|---|";
  for (const std::string& column : table.columns) {
    text += " " + column + " |";
    rule += "---|";
  }
  text += rule + "\n";
  for (const std::string& row : table.rows) {
    text += "| " + row + " |";
    for (const std::string& column : table.columns) {
      const auto cell = table.cells.find({row, column});
      text += cell == table.cells.end()
                  ? " not run |"
                  : fmt::format(" {}{:.2f} ({}) |", cell->second->verdict == "fail" ? "**FAIL** " : "",
                                cell->second->observed, theory(*cell->second));
    }
    text += "\n";
  }
  return text;
}

}  // namespace reports
