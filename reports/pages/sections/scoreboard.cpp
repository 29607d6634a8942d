#include "reports/pages/sections/scoreboard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/pages/html/page.hpp"
#include "reports/records/report_data.hpp"
#include "reports/summaries/scoreboard.hpp"

namespace reports {
namespace {

/// "2e-3": one significant digit, for a narrow cell.
std::string brief(double value) {
  if (!std::isfinite(value)) return "-";
  std::string text = fmt::format("{:.0e}", value);
  const auto e = text.find('e');
  std::string exponent = text.substr(e + 1);
  const bool negative = exponent.front() == '-';
  exponent.erase(0, exponent.find_first_not_of("+-0"));
  return text.substr(0, e) + (exponent.empty() ? "" : std::string("e") + (negative ? "-" : "") + exponent);
}

const char* mark(const std::string& outcome) {
  return outcome == "survived" ? "✓" : outcome == "degraded" ? "~" : outcome == "diverged" ? "✗" : "?";
}

std::string optional(double value) {
  return std::isnan(value) ? "-" : number(value, 3);
}

std::string cell(const ScoreRecord& s) {
  const std::string value = s.outcome == "diverged" ? brief(s.t_diverged) : brief(s.error);
  std::string hover = fmt::format("{}, {}: {}", s.hard_case, s.scheme, s.outcome);
  if (s.outcome == "diverged")
    hover += fmt::format(" after {} s ({})", optional(s.t_diverged), s.status);
  else
    hover += fmt::format(", relative L2 error {} ({}), energy ratio {}", optional(s.error), s.location,
                         optional(s.energy_ratio));
  hover += fmt::format("; expected: {}, {}", s.expected, s.reason);
  return fmt::format("<td class=\"{}{}\" title=\"{}\">{}{}{}</td>", html_text(s.outcome),
                     as_expected(s) ? "" : " unexpected", html_text(hover), mark(s.outcome), value,
                     as_expected(s) ? "" : "<br>expected " + html_text(s.expected));
}

/// "flip, usf" under its basis, "flip, usf, reset" for a variant linear_flip_usf_reset, or its own name.
std::string row_label(const ScoreRecord& s) {
  const std::string parts = s.basis + "_" + s.transfer + "_" + s.stepping;
  const std::string label = s.transfer + ", " + s.stepping;
  if (s.scheme == parts) return label;
  return s.scheme.starts_with(parts + "_") ? label + ", " + s.scheme.substr(parts.size() + 1) : s.scheme;
}

std::string board(const std::vector<ScoreRecord>& scores, const std::vector<CaseSummary>& cases) {
  std::vector<std::string> bases;
  std::map<std::string, std::vector<const ScoreRecord*>> rows;  // by basis, one of each scheme
  std::map<std::pair<std::string, std::string>, const ScoreRecord*> cells;
  for (const ScoreRecord& s : scores) {
    if (std::find(bases.begin(), bases.end(), s.basis) == bases.end()) bases.push_back(s.basis);
    auto& schemes = rows[s.basis];
    if (std::none_of(schemes.begin(), schemes.end(), [&](const auto* r) { return r->scheme == s.scheme; }))
      schemes.push_back(&s);
    cells[{s.scheme, s.study}] = &s;
  }
  std::string head = "<th>transfer, stepping</th>";
  for (const CaseSummary& c : cases)
    head += fmt::format("<th title=\"{}\"><a href=\"#board-{}\"><span>{}</span></a></th>", html_text(c.study),
                        html_anchor(c.study), html_text(c.hard_case));
  std::string body;
  for (const std::string& basis : bases) {
    body += fmt::format("<tr class=\"group\"><th>{}</th><td colspan=\"{}\"></td></tr>\n", html_text(basis),
                        cases.size());
    for (const ScoreRecord* scheme : rows[basis]) {
      body += "<tr><th>" + html_text(row_label(*scheme)) + "</th>";
      for (const CaseSummary& c : cases) {
        const auto found = cells.find({scheme->scheme, c.study});
        body += found == cells.end() ? "<td class=\"none\">·</td>" : cell(*found->second);
      }
      body += "</tr>\n";
    }
  }
  return "<div class=\"board\"><table>\n<thead><tr>" + head + "</tr></thead>\n<tbody>\n" + body +
         "</tbody>\n</table></div>\n";
}

/// Thresholds of a case and the reasons of its expectations, each with the number of schemes it is for.
std::string notes(const std::vector<ScoreRecord>& scores, const CaseSummary& c) {
  const ScoreRecord* any = nullptr;
  std::vector<std::pair<std::string, std::string>> order;  // outcome expected, reason
  std::map<std::pair<std::string, std::string>, std::size_t> schemes;
  for (const ScoreRecord& s : scores) {
    if (s.study != c.study) continue;
    any = &s;
    if (schemes[{s.expected, s.reason}]++ == 0) order.emplace_back(s.expected, s.reason);
  }
  std::string band;
  if (any->energy_lower > 0 || std::isfinite(any->energy_upper))
    band = fmt::format(", or with an energy ratio outside {} to {}", number(any->energy_lower),
                       number(any->energy_upper));
  std::string text = fmt::format(
      "<h4 id=\"board-{}\">{}</h4>\n<p>{} survived, {} degraded, {} diverged, {} unexpected. Degraded: error "
      "({}) above {}{}. <span class=\"faint\">Why: {}. Study <a href=\"#{}\">{}</a>.</span></p>\n<ul>\n",
      html_anchor(c.study), html_text(c.hard_case), c.survived, c.degraded, c.diverged, c.unexpected,
      html_text(any->location), number(any->degraded_above), band, html_text(any->thresholds),
      html_anchor(c.study), html_text(c.study));
  for (const auto& key : order)
    text += fmt::format("<li><span class=\"fate {0}\">{0}</span> ({1}): {2}</li>\n", html_text(key.first),
                        schemes[key], html_text(key.second));
  return text + "</ul>\n";
}

}  // namespace

std::string html_scoreboard(const std::vector<ScoreRecord>& scores) {
  if (scores.empty()) return "";
  const std::vector<CaseSummary> cases = summarise(scores);
  std::string text =
      "<section>\n<h3 id=\"scoreboard\">Stability scoreboard</h3>\n"
      "<p>Every scheme on every hard case: "
      "<span class=\"fate survived\">✓ error</span> survived, "
      "<span class=\"fate degraded\">~ error</span> degraded, "
      "<span class=\"fate diverged\">✗ time [s]</span> diverged. A red frame marks an outcome that "
      "the study did not expect. <span class=\"faint\">Error: relative L2 error of velocity at "
      "the end; time: from the start until the root mean square velocity exceeded ten times its scale, or "
      "the "
      "run broke down; energy ratio (hover): kinetic energy of the particles over the exact "
      "solution's at the same places, - for a fluid at rest.</span></p>\n" +
      board(scores, cases) + "<details><summary>What was expected, and why</summary>\n";
  for (const CaseSummary& c : cases) text += notes(scores, c);
  return text + "</details>\n</section>\n";
}

}  // namespace reports
