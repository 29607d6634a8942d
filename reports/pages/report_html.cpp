#include "reports/pages/report_html.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reports/pages/html_matrix.hpp"
#include "reports/pages/html_page.hpp"
#include "reports/pages/html_scoreboard.hpp"
#include "reports/pages/html_stability.hpp"
#include "reports/pages/html_study.hpp"
#include "reports/records/scoreboard.hpp"
#include "reports/records/work_precision.hpp"

namespace reports {
namespace {

std::string banner(const ReportData& data) {
  std::string text =
      fmt::format("<header class=\"banner {}\">\n<h1>{}</h1>\n", passed(data.results) ? "pass" : "fail",
                  html_text(verdict_line(data.results)));
  if (data.provenance) {
    text += fmt::format("<p class=\"faint\">mpm-verify {} ({}), started {}</p>\n",
                        html_text(data.provenance->build.version), html_text(data.provenance->build.commit),
                        html_text(data.provenance->started));
  }
  return text + "</header>\n";
}

std::string warning_list(const ReportData& data) {
  if (data.warnings.empty()) return "";
  std::string text = "<section class=\"warnings\">\n<h3>Warnings</h3>\n<ul>\n";
  for (const std::string& warning : data.warnings) text += "<li>" + html_text(warning) + "</li>\n";
  return text + "</ul>\n</section>\n";
}

std::string contents(const ReportData& data) {
  std::string text = "<nav aria-label=\"Contents\">\n<b>Contents</b>\n<ul>\n";
  if (!data.results.matrix.empty()) text += "<li><a href=\"#matrix\">Order matrix</a></li>\n";
  if (!data.results.scores.empty()) text += "<li><a href=\"#scoreboard\">Stability scoreboard</a></li>\n";
  if (!data.results.stability.empty()) text += "<li><a href=\"#stability\">Stability limits</a></li>\n";
  if (!data.results.claims.empty()) text += "<li><a href=\"#claims\">Claims judged</a></li>\n";
  if (!cheapest_runs(data.results).empty())
    text += "<li><a href=\"#cheapest\">Cheapest way to an error</a></li>\n";
  for (const StudyRecord& study : studies_of(data.results)) {
    std::size_t held = 0;
    const auto checks = checks_of(data.results, study.study);
    for (const CheckRecord* check : checks) held += holds(*check);
    const bool good = held == checks.size();
    text += fmt::format("<li class=\"{}\"><a href=\"#{}\">{}</a>", good ? "pass" : "fail",
                        html_anchor(study.study), html_text(study.title.empty() ? study.study : study.title));
    if (!checks.empty()) text += fmt::format(" <b>{} of {}</b>", held, checks.size());
    text += "</li>\n";
  }
  return text +
         "<li><a href=\"#runs\">Runs and timing</a></li>\n<li><a href=\"#provenance\">Provenance</a></li>\n"
         "</ul>\n</nav>\n";
}

/// Statements of others, each with its verdict and the numbers that it rests on.
std::string claim_section(const std::vector<ClaimRecord>& claims) {
  if (claims.empty()) return "";
  std::string rows;
  for (const ClaimRecord& claim : claims) {
    rows += fmt::format(
        "<tr><td>{}</td><td class=\"w\">{}</td><td class=\"{}\"><b>{}</b>{}</td><td class=\"w\">{}</td>"
        "<td class=\"w\">{}</td></tr>\n",
        html_text(claim.source), html_text(claim.statement), claim.stands ? "pass" : "fail",
        html_text(claim.verdict), claim.stands ? "" : " (not borne out: a check behind it fails)",
        html_text(claim.note), html_text(claim.measured));
  }
  return "<section>\n<h2 id=\"claims\">Claims judged</h2>\n" +
         html_table(
             "<th>source</th><th>claim</th><th>verdict</th><th>what to make of it</th><th>measured</th>",
             rows, "cards") +
         "</section>\n";
}

std::string run_section(const Results& results) {
  std::string rows;
  for (const RunRecord& run : results.runs) {
    std::string wall = "-", speed = "-";
    for (const TimingRecord& timing : results.timings) {
      if (timing.run != run.run) continue;
      if (std::isfinite(timing.wall_s)) wall = number(timing.wall_s, 3);
      if (std::isfinite(timing.particle_steps_per_s)) speed = number(timing.particle_steps_per_s / 1e6, 3);
    }
    const std::string scheme = run.stepping + (run.reset == "never" ? "" : ", reset " + run.reset);
    rows += fmt::format(
        "<tr><td class=\"w\">{}</td><td>{}, {}</td><td>{}, {}, {}</td><td class=\"n\">{}</td><td "
        "class=\"n\">{}</td>"
        "<td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td "
        "class=\"{}\">{}</td></tr>\n",
        html_text(run.run), html_text(run.scene), html_text(run.fluid), html_text(run.basis),
        html_text(run.transfer), html_text(scheme), run.cells, run.particles, number(run.dt), run.steps, wall,
        speed,
        completed(run)                      ? "pass"
        : expected_to_diverge(results, run) ? "faint"
                                            : "fail",
        html_text(run.status));
  }
  return "<section>\n<h2 id=\"runs\">Runs and timing</h2>\n" +
         html_table(
             "<th>run</th><th>scene, fluid</th><th>basis, transfer, stepping</th><th "
             "class=\"n\">cells</th>"
             "<th class=\"n\">particles</th><th class=\"n\">dt [s]</th><th class=\"n\">steps</th>"
             "<th class=\"n\">wall [s]</th><th class=\"n\">speed</th><th>status</th>",
             rows) +
         "<p class=\"faint\">Speed in 10⁶ particle-steps/s; cells across the scene's characteristic "
         "length.</p>\n"
         "</section>\n";
}

std::string provenance_section(const std::optional<Provenance>& provenance) {
  std::string text = "<section>\n<h2 id=\"provenance\">Provenance</h2>\n";
  if (!provenance)
    return text + "<p>No provenance.json: what made these results is not known.</p>\n</section>\n";
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
  for (const auto& [name, value] : facts) {
    rows += fmt::format("<tr><th>{}</th><td><code>{}</code></td></tr>\n", name, html_text(value));
  }
  return text + "<div class=\"scroll\"><table><tbody>\n" + rows + "</tbody></table></div>\n</section>\n";
}

}  // namespace

std::string html_report(const std::filesystem::path& dir, const ReportData& data) {
  std::string body = banner(data);
  const auto failed = failures(data.results);
  if (!failed.empty())
    body += "<section>\n<h2 id=\"failures\">Failures</h2>\n" + html_checks(failed, true) + "</section>\n";
  body += warning_list(data);
  body += contents(data);
  body += claim_section(data.results.claims);
  body += html_scoreboard(data.results.scores);
  body += html_matrix(data.results.matrix);
  body += html_cheapest(data.results);
  body += html_stability(data.results.stability);
  for (const StudyRecord& study : studies_of(data.results)) body += html_study(dir, data, study);
  body += run_section(data.results);
  body += provenance_section(data.provenance);
  return html_page(verdict_line(data.results), body);
}

}  // namespace reports
