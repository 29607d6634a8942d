#include "reports/pages/report_markdown.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "reports/pages/sections/controls.hpp"
#include "reports/pages/sections/matrix.hpp"
#include "reports/pages/sections/stability.hpp"
#include "reports/pages/sections/time_steps.hpp"
#include "reports/summaries/scoreboard.hpp"
#include "reports/summaries/work_precision.hpp"

namespace reports {
namespace {

// A CI summary has a size limit (1 MiB at the common hosts): beyond this many rows a study's passing rows are
// counted.
constexpr std::size_t most_rows = 40;

std::string check_row(const CheckRecord& check, bool with_study) {
  return fmt::format("| {} | {}{} | {} | {} | {} |\n", holds(check) ? "pass" : "**FAIL**",
                     with_study ? markdown_text(check.study) + " | " : "", markdown_text(check.check),
                     markdown_text(with_unit(observed(check), check)),
                     markdown_text(with_unit(bounds(check), check)), markdown_text(check.reason));
}

std::string failure_section(const Results& results) {
  const auto failed = failures(results);
  if (failed.empty()) return "";
  std::string text =
      "\n## Failures\n\n| verdict | study | check | observed | bounds | reason for the bounds |\n"
      "|---|---|---|---|---|---|\n";
  for (const CheckRecord* check : failed) text += check_row(*check, true);
  return text;
}

std::string check_section(const Results& results) {
  std::string text = "\n## Checks\n";
  for (const StudyRecord& study : studies_of(results)) {
    const auto checks = checks_of(results, study.study);
    if (checks.empty()) continue;
    text += fmt::format("\n### {}\n\n", markdown_text(study.title.empty() ? study.study : study.title));
    if (!study.claim.empty()) text += markdown_text(study.claim) + "\n\n";
    if (!study.left_out.empty()) text += "Left out of the model: " + markdown_text(study.left_out) + ".\n\n";
    std::string rows;
    std::size_t shown = 0, hidden = 0;
    for (const CheckRecord* check : checks) {
      // What the scoreboard counts already is shown where it fails.
      if (!holds(*check) || (shown < most_rows && check->unit != outcome_unit)) {
        rows += check_row(*check, false);
        ++shown;
      } else {
        ++hidden;
      }
    }
    if (shown > 0)
      text +=
          "| verdict | check | observed | bounds | reason for the bounds |\n|---|---|---|---|---|\n" + rows;
    if (hidden > 0)
      text += fmt::format("\n{}{} checks of this study hold: see checks.csv or report.html.\n", hidden,
                          shown > 0 ? " more" : "");
  }
  return text;
}

std::string claim_section(const std::vector<ClaimRecord>& claims) {
  if (claims.empty()) return "";
  std::string text =
      "\n## Claims judged\n\n| source | claim | verdict | what to make of it | measured "
      "|\n|---|---|---|---|---|\n";
  for (const ClaimRecord& claim : claims) {
    text += fmt::format("| {} | {} | {}{} | {} | {} |\n", markdown_text(claim.source),
                        markdown_text(claim.statement), markdown_text(claim.verdict),
                        claim.stands ? "" : " (**not borne out**)", markdown_text(claim.note),
                        markdown_text(claim.measured));
  }
  return text;
}

std::string rate_table_markdown(const RateTable& table) {
  std::string text =
      fmt::format("\n{}: {}, {}, norm {}\n\n| {} |", markdown_text(table.variant), table.axis,
                  markdown_text(table.location), norm_symbol(table.norm), step_symbol(table.axis));
  std::string rule = "\n|---|";
  for (const double t : table.times) {
    text += fmt::format(" {}, t = {} s | rate |", table.axis == "time" ? "difference" : "error", number(t));
    rule += "---|---|";
  }
  text += rule + "\n";
  for (const RateTable::Row& row : table.rows) {
    text += fmt::format("| {} |", number(row.step));
    for (std::size_t i = 0; i < row.errors.size(); ++i) {
      text += fmt::format(" {}{} | {} |", number(row.errors[i], 3), row.used[i] ? "" : " (not fitted)",
                          rate(row.rates[i]));
    }
    text += "\n";
  }
  return text;
}

std::string order_section(const Results& results) {
  std::string text;
  for (const StudyRecord& study : studies_of(results)) {
    std::string rows;
    std::size_t count = 0;
    for (const OrderRecord* order : orders_of(results, study.study)) {
      if (order->norm != "l2" || ++count > most_rows) continue;
      rows += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", markdown_text(order->variant),
                          order->axis, markdown_text(order->location), number(order->t),
                          std::isnan(order->theoretical) ? "-" : number(order->theoretical),
                          order_with_interval(*order), order->classification);
    }
    const auto tables = rate_tables(results, study.study);
    if (rows.empty() && tables.empty()) continue;
    text += fmt::format("\n### {}\n", markdown_text(study.title.empty() ? study.study : study.title));
    if (!rows.empty()) {
      text +=
          "\n| variant | axis | location | t [s] | theory | observed L2 order [95 %] | class |\n"
          "|---|---|---|---|---|---|---|\n" +
          rows;
      if (count > most_rows)
        text += fmt::format("\n{} more in orders.csv and report.html.\n", count - most_rows);
    }
    if (tables.empty() || tables.size() > most_rows) continue;
    text += "\n<details><summary>Errors and rates</summary>\n";
    for (const RateTable& table : tables) text += rate_table_markdown(table);
    text += "\n</details>\n";
  }
  return text.empty() ? "" : "\n## Orders of convergence\n" + text;
}

std::string diverged_section(const Results& results) {
  std::string rows;
  for (const RunRecord& run : results.runs) {
    if (completed(run) || expected_to_diverge(results, run)) continue;
    rows += fmt::format("| {} | {} | {} |\n", markdown_text(run.run), markdown_text(run.study),
                        markdown_text(run.status));
  }
  return rows.empty() ? ""
                      : "\n## Runs that did not complete\n\n| run | study | status |\n|---|---|---|\n" + rows;
}

std::string provenance_section(const std::optional<Provenance>& provenance) {
  if (!provenance) return "";
  const Provenance& p = *provenance;
  return fmt::format(
      "\n## Provenance\n\nmpm-verify {} ({}), {} {}, {}; {}, {} cores, {:.1f} GiB, {}; `{}` at {}\n",
      markdown_text(p.build.version), markdown_text(p.build.commit), markdown_text(p.build.compiler),
      markdown_text(p.build.flags), markdown_text(p.build.build_type), markdown_text(p.machine.cpu),
      p.machine.cores, static_cast<double>(p.machine.memory_bytes) / (1024.0 * 1024.0 * 1024.0),
      markdown_text(p.machine.os),
      [&] {
        std::string command;
        for (const char c : p.command) command += c == '`' || static_cast<unsigned char>(c) < 0x20 ? '\'' : c;
        return command;
      }(),
      markdown_text(p.started));
}

}  // namespace

std::string markdown_text(const std::string& text) {
  static const std::string special = "\\`*[]|~#";
  std::string literal;
  for (const char c : text) {
    if (c == '<') {
      literal += "&lt;";
    } else if (c == '>') {
      literal += "&gt;";
    } else if (c == '&') {
      literal += "&amp;";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      literal += ' ';
    } else {
      if (special.find(c) != special.npos) literal += '\\';
      literal += c;
    }
  }
  return literal;
}

std::string markdown_report(const ReportData& data) {
  std::string text = "# " + verdict_line(data.results) + "\n";
  text += failure_section(data.results);
  if (!data.warnings.empty()) text += "\n## Warnings\n\n";
  for (const std::string& warning : data.warnings) text += "- " + markdown_text(warning) + "\n";
  text += claim_section(data.results.claims);
  text += markdown_controls(data.results.controls);
  text += markdown_scoreboard(data.results.scores);
  text += markdown_matrix(data.results.matrix);
  text += markdown_cheapest(data.results);
  text += markdown_time_steps(data.results);
  text += markdown_stability(data.results.stability);
  text += check_section(data.results);
  text += order_section(data.results);
  text += diverged_section(data.results);
  text += provenance_section(data.provenance);
  return text;
}

}  // namespace reports
