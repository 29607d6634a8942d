#include "reports/pages/html/first_screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/pages/html/page.hpp"
#include "reports/pages/sections/study.hpp"
#include "reports/records/changes.hpp"

namespace reports {
namespace {

std::string range(const Headline& headline) {
  if (std::isnan(headline.lowest) || std::isnan(headline.highest)) return "nan";
  const CheckRecord& check = *headline.decisive;
  // Of an error with an upper bound the largest matters, of an order both ends.
  if (check.lower == 0 || !std::isfinite(check.lower)) return number(headline.highest, 3);
  const std::string low = number(headline.lowest), high = number(headline.highest);
  return low == high ? low : low + " to " + high;
}

std::string headline_cards(const ReportData& data, const PageFigures& figures) {
  const std::vector<Headline> headlines = headlines_of(data, 6);
  if (headlines.empty()) return "";
  std::string text = "<ul class=\"headlines\">\n";
  for (const Headline& headline : headlines) {
    text += fmt::format(
        "<li class=\"{}\"><p>{}</p><p class=\"value\">{}</p><p class=\"faint\">{}: {}; {} in <a "
        "href=\"#{}\">{}</a></p>{}</li>\n",
        headline.holds ? "pass" : "fail", html_text(headline.title),
        html_text(with_unit(range(headline), *headline.decisive)), headline.holds ? "required" : "REQUIRED",
        html_text(bounds(*headline.decisive)),
        headline.checks == 1 ? "one check"
        : headline.one_band  ? fmt::format("{} checks", headline.checks)
                             : fmt::format("the nearest to its bounds of {} checks", headline.checks),
        html_anchor(headline.study), html_text(headline.study), figures.thumbnail(headline.figure));
  }
  return text + "</ul>\n";
}

std::string scope(const ReportData& data, const std::vector<Chapter>& chapters) {
  std::string verified;
  std::size_t studies = 0;
  for (const Chapter& chapter : chapters) {
    studies += chapter.studies.size();
    verified += fmt::format("{}<a href=\"#{}\">{}</a> ({})", verified.empty() ? "" : "; ",
                            chapter_anchor(chapter), html_text(chapter.title), chapter.studies.size());
  }
  std::set<std::string> methods;
  for (const RunRecord& run : data.results.runs) methods.insert(run.method);
  std::string names;
  for (const std::string& method : methods) names += (names.empty() ? "" : ", ") + html_text(method);
  std::string text = "<dl class=\"facts\">\n";
  text += fmt::format("<dt>Verified</dt><dd>{} studies, {} runs{}: {}</dd>\n", studies,
                      data.results.runs.size(), names.empty() ? "" : " of " + names, verified);
  const std::string not_verified = scope_of(data.results);
  if (!not_verified.empty()) text += "<dt>Not verified</dt><dd>" + html_text(not_verified) + "</dd>\n";
  text += "<dt>Since the last run</dt><dd>" + html_text(changes_line(data.changes)) + "</dd>\n";
  return text + "</dl>\n";
}

std::string changes_section(const ReportData& data) {
  if (!data.changes) return "";
  std::string rows;
  std::size_t shown = 0, all = 0;
  for (const ChangeRecord& change : *data.changes) {
    if (is_the_earlier_run(change)) continue;
    if (++all > 40) continue;
    ++shown;
    rows += fmt::format(
        "<tr><td class=\"{}\">{}</td><td>{}</td><td class=\"w\">{}</td><td class=\"n\">{}</td><td "
        "class=\"n\">{}</td><td>{}</td></tr>\n",
        change.verdict == "worse" ? "fail" : "", html_text(change.verdict), html_text(change.file),
        html_text(change.name), number(change.before), number(change.after), html_text(change.note));
  }
  if (rows.empty()) return "";
  return "<details id=\"changes\"><summary>What changed since the last run</summary>\n" +
         html_table(
             "<th>verdict</th><th>file</th><th>number</th><th class=\"n\">before</th><th "
             "class=\"n\">now</th><th>note</th>",
             rows) +
         (all > shown ? fmt::format("<p class=\"faint\">{} more in changes.csv.</p>\n", all - shown) : "") +
         "</details>\n";
}

std::string option_list(const std::set<std::string>& values) {
  std::string text = "<option value=\"\">all</option>";
  for (const std::string& value : values)
    text += fmt::format("<option value=\"{0}\">{1}</option>", html_token(value), html_text(value));
  return text;
}

}  // namespace

std::string chapter_anchor(const Chapter& chapter) {
  return "chapter-" + html_anchor(chapter.title).substr(6);
}

std::string first_screen(const ReportData& data, const std::vector<Chapter>& chapters,
                         const PageFigures& figures) {
  std::string text =
      fmt::format("<header class=\"banner {}\" id=\"top\">\n<h1>{}</h1>\n",
                  passed(data.results) ? "pass" : "fail", html_text(verdict_line(data.results)));
  if (data.provenance)
    text += fmt::format("<p class=\"faint\">mpm-verify {} ({}), started {}</p>\n",
                        html_text(data.provenance->build.version), html_text(data.provenance->build.commit),
                        html_text(data.provenance->started));
  text += "</header>\n";
  const auto failed = failures(data.results);
  if (!failed.empty())
    text += "<section id=\"failures\">\n<h2>Failures</h2>\n" + html_checks(failed, true) + "</section>\n";
  text += scope(data, chapters) + headline_cards(data, figures) + changes_section(data);
  if (!data.warnings.empty()) {
    text += "<section class=\"warnings\">\n<h3>Warnings</h3>\n<ul>\n";
    for (const std::string& warning : data.warnings) text += "<li>" + html_text(warning) + "</li>\n";
    text += "</ul>\n</section>\n";
  }
  return text;
}

std::string side_column(const ReportData& data, const std::vector<Chapter>& chapters) {
  std::set<std::string> topics, schemes;
  std::string list;
  for (const Chapter& chapter : chapters) {
    std::string studies;
    bool good = true;
    for (const StudyRecord& study : chapter.studies) {
      const auto checks = checks_of(data.results, study.study);
      const bool holds_all =
          std::ranges::all_of(checks, [](const CheckRecord* check) { return holds(*check); });
      good = good && holds_all && !checks.empty();
      studies +=
          fmt::format("<li data-study=\"{0}\"><a href=\"#{0}\">{1}</a>{2}</li>\n", html_anchor(study.study),
                      html_text(study.study), holds_all ? "" : " <b class=\"fail\">FAIL</b>");
      for (const std::string& word : schemes_of(data.results, study.study)) schemes.insert(word);
    }
    topics.insert(chapter.title);
    list += fmt::format(
        "<li data-chapter=\"{0}\"><b class=\"badge {1}\">{2}</b><a "
        "href=\"#{0}\">{3}</a>\n<details{5}><summary>{4} "
        "studies</summary><ul>\n",
        chapter_anchor(chapter), good ? "pass" : "fail", good ? "✓" : "✗", html_text(chapter.title),
        chapter.studies.size(), good ? "" : " open");
    list += studies + "</ul></details></li>\n";
  }
  return "<aside class=\"side\">\n<details class=\"menu\" open>\n<summary>Contents and "
         "filters</summary>\n<form class=\"filters\" role=\"search\" onsubmit=\"return false\">\n"
         "<label for=\"search\">Search (key /)</label><input id=\"search\" type=\"search\" "
         "autocomplete=\"off\">\n"
         "<label for=\"filter-status\">Status</label><select id=\"filter-status\"><option "
         "value=\"\">all</option><option value=\"pass\">pass</option><option "
         "value=\"fail\">fail</option></select>\n"
         "<label for=\"filter-topic\">Topic</label><select id=\"filter-topic\">" +
         option_list(topics) +
         "</select>\n<label for=\"filter-scheme\">Method, basis, transfer, stepping</label><select "
         "id=\"filter-scheme\">" +
         option_list(schemes) +
         "</select>\n<button type=\"button\" id=\"reset\">Show all</button>\n<p id=\"count\" role=\"status\" "
         "class=\"faint\"></p></form>\n<nav aria-label=\"Contents\">\n<ul>\n<li><a "
         "href=\"#top\">Verdict</a></li>\n" +
         list + "<li><a href=\"#provenance\">Provenance</a></li>\n</ul>\n</nav>\n</details>\n</aside>\n";
}

std::string provenance_table(const std::optional<Provenance>& provenance) {
  if (!provenance) return "<p>No provenance.json: what made these results is not known.</p>\n";
  const Provenance& p = *provenance;
  const std::pair<const char*, std::string> facts[] = {
      {"version", p.build.version},
      {"commit", p.build.commit},
      {"compiler", p.build.compiler},
      {"flags", p.build.flags},
      {"build type", p.build.build_type},
      {"processor", fmt::format("{}, {} cores online", p.machine.cpu, p.machine.cores)},
      {"memory",
       fmt::format("{:.1f} GiB", static_cast<double>(p.machine.memory_bytes) / (1024.0 * 1024 * 1024))},
      {"system", p.machine.os},
      {"command", p.command},
      {"started", p.started},
  };
  std::string rows;
  for (const auto& [name, value] : facts)
    rows +=
        fmt::format("<tr><th scope=\"row\">{}</th><td><code>{}</code></td></tr>\n", name, html_text(value));
  return "<div class=\"scroll\"><table><tbody>\n" + rows + "</tbody></table></div>\n";
}

}  // namespace reports
