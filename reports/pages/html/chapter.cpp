#include "reports/pages/html/chapter.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/pages/html/first_screen.hpp"
#include "reports/pages/html/page.hpp"
#include "reports/pages/sections/controls.hpp"
#include "reports/pages/sections/matrix.hpp"
#include "reports/pages/sections/scoreboard.hpp"
#include "reports/pages/sections/stability.hpp"
#include "reports/pages/sections/validation.hpp"
#include "reports/summaries/scoreboard.hpp"
#include "reports/summaries/work_precision.hpp"

namespace reports {
namespace {

template <class Record>
std::vector<Record> those_of(const std::vector<Record>& records, const Chapter& chapter) {
  std::vector<Record> chosen;
  for (const Record& record : records)
    if (chapter.has(record.study)) chosen.push_back(record);
  return chosen;
}

/// The order matrix has no study of its own: it stands where the orders of its schemes do.
std::vector<MatrixRecord> matrix_of(const Results& results, const Chapter& chapter) {
  std::vector<MatrixRecord> chosen;
  for (const MatrixRecord& record : results.matrix) {
    const std::string variant = record.basis + "_" + record.transfer + "_" + record.stepping;
    const auto order = std::ranges::find_if(results.orders, [&](const OrderRecord& o) {
      return o.variant == variant && o.axis == record.axis && o.location == record.location;
    });
    if (order != results.orders.end() && chapter.has(order->study)) chosen.push_back(record);
  }
  return chosen;
}

/// Runs and times of the chapter alone, for the tables of costs.
Results costs_of(const Results& results, const Chapter& chapter) {
  Results own;
  own.runs = those_of(results.runs, chapter);
  std::vector<std::string> names;
  for (const RunRecord& run : own.runs) names.push_back(run.run);
  std::ranges::sort(names);
  const auto known = [&](const std::string& run) { return std::ranges::binary_search(names, run); };
  std::ranges::copy_if(results.timings, std::back_inserter(own.timings), known, &TimingRecord::run);
  std::ranges::copy_if(results.errors, std::back_inserter(own.errors), known, &ErrorRecord::run);
  return own;
}

std::string study_table(const ReportData& data, const Chapter& chapter) {
  std::string rows;
  for (const StudyRecord& study : chapter.studies) {
    const auto checks = checks_of(data.results, study.study);
    const auto held = std::ranges::count_if(checks, [](const CheckRecord* check) { return holds(*check); });
    const bool good = static_cast<std::size_t>(held) == checks.size() && held > 0;
    const CheckRecord* nearest = decisive(checks);
    rows += fmt::format(
        "<tr data-study=\"{0}\"><td class=\"{1}\">{2}</td><td class=\"w\"><a href=\"#{0}\">{3}</a></td><td "
        "class=\"n\">{4} of {5}</td><td class=\"w\" data-label=\"decides\">{6}</td></tr>\n",
        html_anchor(study.study), good ? "pass" : "fail", good ? "pass" : "FAIL",
        html_text(study.title.empty() ? study.study : study.title), held, checks.size(),
        nearest == nullptr
            ? "no check was made"
            : html_text(fmt::format("{}: {} ({})", nearest->check, with_unit(observed(*nearest), *nearest),
                                    bounds(*nearest))));
  }
  return html_table("<th>verdict</th><th>study</th><th class=\"n\">checks</th><th>nearest to its bound</th>",
                    rows, "cards");
}

/// The evidence of a claim: the checks that its text of measured numbers names.
std::vector<const CheckRecord*> evidence_of(const Results& results, const ClaimRecord& claim) {
  auto checks = checks_of(results, claim.study);
  const std::string text = "; " + claim.measured;
  std::erase_if(checks,
                [&](const CheckRecord* check) { return text.find("; " + check->check + ": ") == text.npos; });
  return checks;
}

}  // namespace

std::string html_claims(const Results& results, const Chapter& chapter) {
  const std::vector<ClaimRecord> claims = those_of(results.claims, chapter);
  if (claims.empty()) return "";
  std::string text = "<section id=\"claims\">\n<h3>What was claimed, and the verdict</h3>\n";
  for (const ClaimRecord& claim : claims) {
    const auto checks = evidence_of(results, claim);
    const CheckRecord* deciding = decisive(checks);
    text += fmt::format(
        "<article class=\"claim\" id=\"claim-{}-{}\"><p class=\"faint\">{}</p><blockquote>{}</blockquote>\n"
        "<p><span class=\"verdict {}\"><b>{}</b>{}</span>{}</p>\n",
        html_anchor(claim.study).substr(6), html_anchor(claim.claim).substr(6), html_text(claim.source),
        html_text(claim.statement), claim.stands ? "pass" : "fail", html_text(claim.verdict),
        claim.stands ? "" : " (not borne out: a check behind it fails)",
        deciding == nullptr
            ? ""
            : html_text(fmt::format(". {}: {} ({})", deciding->check,
                                    with_unit(observed(*deciding), *deciding), bounds(*deciding))));
    text += fmt::format("<details><summary>What to make of it{}</summary><p>{}</p>\n",
                        checks.size() > 1 ? fmt::format(", and all {} numbers", checks.size()) : "",
                        html_text(claim.note));
    text += (checks.empty() ? "<p>" + html_text(claim.measured) + "</p>" : html_checks(checks, false)) +
            "</details></article>\n";
  }
  return text + "</section>\n";
}

std::string html_chapter(const ReportData& data, const Chapter& chapter, PageFigures& figures,
                         Medium medium) {
  const Results& results = data.results;
  std::string text = fmt::format(
      "<section class=\"chapter\" id=\"{0}\">\n<h2>{1}<a class=\"link\" href=\"#{0}\" "
      "aria-label=\"Link to this chapter\">#</a></h2>\n",
      chapter_anchor(chapter), html_text(chapter.title));
  if (!chapter.paragraph.empty()) text += "<p>" + html_text(chapter.paragraph) + "</p>\n";
  if (!chapter.figure.empty()) text += figures.shown(chapter.figure);
  text += html_claims(results, chapter);
  text += html_controls(those_of(results.controls, chapter));
  text += study_table(data, chapter);
  text += html_validation(results, chapter, figures);
  text += html_scoreboard(those_of(results.scores, chapter));
  text += html_matrix(matrix_of(results, chapter));
  text += html_cheapest(costs_of(results, chapter));
  text += html_stability(those_of(results.stability, chapter));
  for (const StudyRecord& study : chapter.studies)
    text += html_study(data, study, chapter.title, figures, medium);
  return text + "</section>\n";
}

}  // namespace reports
