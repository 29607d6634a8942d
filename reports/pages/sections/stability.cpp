#include "reports/pages/sections/stability.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reports/pages/html/page.hpp"
#include "reports/pages/sections/crossed_table.hpp"
#include "reports/records/report_data.hpp"

namespace reports {
namespace {

std::string row_of(const StabilityRecord& record) {
  return record.basis + ", " + record.transfer + ", " + record.stepping;
}

std::string ray_of(const StabilityRecord& record) {
  if (record.cfl_tested == 0) return "viscous";
  if (record.r_tested == 0) return "acoustic";
  return fmt::format("r:CFL = 1:{:.3g}", record.cfl_tested / record.r_tested);
}

std::string column_of(const StabilityRecord& record) {
  return record.waves + " waves, " + record.motion + "; " + ray_of(record) + "; " + record.lattice;
}

/// A limit measured by several studies stands once.
CrossedTable<StabilityRecord> crossed(const std::vector<StabilityRecord>& limits) {
  CrossedTable<StabilityRecord> table;
  for (const StabilityRecord& record : limits)
    if (record.kind == "measured") table.add(row_of(record), column_of(record), record);
  return table;
}

/// "1.500" for a ray along an axis, "0.61, 0.61" for r and CFL on another.
std::string limit(double r, double cfl, const StabilityRecord& record) {
  if (!std::isfinite(r) || !std::isfinite(cfl)) return "none";
  if (record.cfl_tested == 0) return fmt::format("{:.4f}", r);
  if (record.r_tested == 0) return fmt::format("{:.4f}", cfl);
  return fmt::format("{:.4f}; {:.4f}", r, cfl);
}

std::string measured(const StabilityRecord& record) {
  return limit(record.r_measured, record.cfl_measured, record);
}
std::string predicted(const StabilityRecord& record) {
  return limit(record.r_predicted, record.cfl_predicted, record);
}

constexpr const char* explanation =
    "Largest stable step: r = nu dt/h^2 on viscous rays, c dt/h on acoustic ones, both on others. Measured "
    "by "
    "bisection on the growth of a random perturbation, and predicted from the spectral radius of the "
    "amplification matrix of the uniform lattice (walls excluded). rest: particles in their seats; offset: "
    "at "
    "rest where they are least stable; streaming: carried through there.";

}  // namespace

std::string html_stability(const std::vector<StabilityRecord>& limits) {
  const CrossedTable<StabilityRecord> table = crossed(limits);
  if (table.rows.empty()) return "";
  std::string head = "<th>basis, transfer, stepping</th>";
  for (const std::string& column : table.columns) {
    std::string title = html_text(column);
    for (std::size_t at = 0; (at = title.find("; ", at)) != std::string::npos;) title.replace(at, 2, "<br>");
    head += "<th class=\"n\">" + title + "</th>";
  }
  std::string rows;
  for (const std::string& row : table.rows) {
    rows += "<tr><td class=\"w\">" + html_text(row) + "</td>";
    for (const std::string& column : table.columns) {
      const auto cell = table.cells.find({row, column});
      if (cell == table.cells.end()) {
        rows += "<td class=\"faint\">not run</td>";
        continue;
      }
      const StabilityRecord& record = *cell->second;
      rows += fmt::format("<td class=\"n\"><b>{}</b><br><span class=\"faint\">theory {}</span></td>",
                          measured(record), predicted(record));
    }
    rows += "</tr>\n";
  }
  return "<section>\n<h3 id=\"stability\">Stability limits</h3>\n<p class=\"faint\">" +
         html_text(explanation) + " \"none\": nothing grew up to the largest step tried.</p>\n" +
         html_table(head, rows) + "</section>\n";
}

std::string markdown_stability(const std::vector<StabilityRecord>& limits) {
  const CrossedTable<StabilityRecord> table = crossed(limits);
  if (table.rows.empty()) return "";
  std::string text = fmt::format("\n## Stability limits\n\n{} Measured (theory).\n\n| scheme |", explanation);
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
                  : fmt::format(" {} ({}) |", measured(*cell->second), predicted(*cell->second));
    }
    text += "\n";
  }
  return text;
}

}  // namespace reports
