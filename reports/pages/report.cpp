#include "reports/pages/report.hpp"

#include <fmt/format.h>

#include "reports/figures/drawing/gnuplot.hpp"
#include "reports/files/atomic_file.hpp"
#include "reports/pages/browser.hpp"
#include "reports/pages/html/report_html.hpp"
#include "reports/pages/junit.hpp"
#include "reports/pages/report_markdown.hpp"
#include "reports/pages/summary.hpp"
#include "reports/records/directory/result_files.hpp"
#include "reports/records/report_data.hpp"
#include "reports/threads/for_each_index.hpp"

namespace reports {
namespace {

void draw_figures(const std::filesystem::path& dir, ReportData& data, const FigureOptions& options) {
  const std::vector<FigureRecord>& records = data.results.figures;
  if (records.empty()) return;
  const std::filesystem::path directory = dir / "figures";
  ensure_directory(directory);
  const Gnuplot gnuplot(options.cache);
  data.figures.resize(records.size());
  for_each_index(records.size(), options.jobs, [&](std::size_t i) {
    data.figures[i].figure = build_figure(dir, records[i], data.results);
  });
  std::vector<Drawing> drawings;
  for (const ReportFigure& shown : data.figures) drawings.push_back({shown.figure.name, shown.figure.script});
  const std::vector<std::string> problems = gnuplot.draw(directory, drawings, options.jobs);
  for (std::size_t i = 0; i < records.size(); ++i)
    data.figures[i].drawn = !drawings[i].script.empty() && problems[i].empty();
  std::size_t lost = 0;
  std::string complaint;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (data.figures[i].figure.script.empty())
      data.warnings.push_back(fmt::format("figure {}: there is nothing finite to draw", records[i].figure));
    if (!problems[i].empty() && lost++ == 0) complaint = problems[i];
  }
  if (lost == 0) return;
  data.warnings.push_back(
      gnuplot.available()
          ? fmt::format("{} of {} figures not drawn: {}", lost, data.figures.size(), complaint)
          : fmt::format(
                "{} of {} figures not drawn: {} is not installed; install gnuplot and run `mpm-verify report "
                "DIR` again",
                lost, data.figures.size(), gnuplot.wanted()));
}

void warn_of_contradictions(ReportData& data) {
  for (const CheckRecord& check : data.results.checks) {
    const bool within = check.lower <= check.observed && check.observed <= check.upper;
    if (check.verdict == (within ? "pass" : "fail")) continue;
    data.warnings.push_back(
        fmt::format("checks.csv: verdict '{}' of '{}' ({}) contradicts its numbers; it counts as {}",
                    check.verdict, check.check, check.study, holds(check) ? "passed" : "failed"));
  }
}

}  // namespace

std::vector<std::string> write_figures(const std::filesystem::path& dir, const FigureOptions& options) {
  ReportData data;
  data.results = read_results(dir);
  draw_figures(dir, data, options);
  return data.warnings;
}

ReportOutcome write_report(const std::filesystem::path& dir, const FigureOptions& options) {
  ReportData data;
  data.results = read_results(dir);
  data.provenance = read_provenance(dir);
  data.changes = read_changes(dir);
  warn_of_contradictions(data);
  if (!data.provenance)
    data.warnings.emplace_back("no provenance.json: what made these results is not known");
  draw_figures(dir, data, options);

  write_file(dir / "report.md", markdown_report(data));
  write_file(dir / "summary.md", markdown_summary(data));
  write_file(dir / "report.html", html_report(dir, data));
  write_file(dir / "junit.xml", junit_report(data.results));
  if (options.pdf) {
    const std::string problem = print_report(dir, html_report(dir, data, Medium::Paper));
    if (!problem.empty()) data.warnings.push_back(problem);
  }

  ReportOutcome outcome;
  outcome.checks_failed = failures(data.results).size();
  outcome.checks_passed = data.results.checks.size() - outcome.checks_failed;
  outcome.passed = passed(data.results);
  outcome.warnings = data.warnings;
  return outcome;
}

}  // namespace reports
