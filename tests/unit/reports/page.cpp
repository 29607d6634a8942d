#include <fmt/format.h>

#include <limits>
#include <string>

#include "reports/compare/earlier_run.hpp"
#include "reports/figures/drawing/gnuplot.hpp"
#include "reports/files/atomic_file.hpp"
#include "reports/pages/html/inline_svg.hpp"
#include "reports/pages/html/svg_marks.hpp"
#include "reports/pages/report.hpp"
#include "reports/pages/sections/study.hpp"
#include "reports/pages/summary.hpp"
#include "reports/records/changes.hpp"
#include "reports/records/chapters.hpp"
#include "reports/records/directory/result_files.hpp"
#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"
#include "tests/study_text.hpp"
#include "tests/unit/reports/sample.hpp"

using namespace reports;

namespace {

CheckRecord check_of(const std::string& study, double observed, double lower, double upper) {
  const bool good = lower <= observed && observed <= upper;
  return {study, "c", observed, lower, upper, "1", good ? "pass" : "fail", "r"};
}

}  // namespace

TEST_CASE("every study stands in one chapter, in the order that chapters.csv gives", "[reports]") {
  ReportData data;
  data.results.studies = {{"a", "A", "", "", "", "waves"},
                          {"b", "B", "", "", "", "new-topic"},
                          {"c", "C", "", "", "", "channels"},
                          {"d", "D", "", ""},
                          {"e", "E", "", "", "", "plates"}};
  data.results.chapters = {{"channels", "Channels", "Between plates.", ""},
                           {"nobody", "Nobody", "", ""},
                           {"waves", "Waves", "", ""},
                           {"plates", "Channels", "", ""},
                           {scope_topic, "Not verified", "Heat.", ""}};
  const auto chapters = chapters_of(data);
  REQUIRE(chapters.size() == 4);
  CHECK(chapters[0].title == "Channels");
  CHECK(chapters[0].studies.size() == 2);
  CHECK(chapters[1].title == "Waves");
  CHECK(chapters[2].title == "New topic");
  CHECK(chapters[3].title == "Studies");
  CHECK(scope_of(data.results) == "Heat.");
}

TEST_CASE("the check nearest to its bound decides; a failure before all, NaN before that", "[reports]") {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  const CheckRecord middle = check_of("s", 2, 1.9, 2.1), edge = check_of("s", 2.09, 1.9, 2.1),
                    small = check_of("s", 1e-9, 0, 1), wrong = check_of("s", 3, 0, 1),
                    none = check_of("s", nan, 0, 1), most = check_of("s", 0.5, -infinity, 1),
                    counted = check_of("s", 0, 0, 0);
  CHECK(margin(middle) == Approx(1));
  CHECK(margin(edge) == Approx(0.1));
  CHECK(margin(small) == Approx(1));
  CHECK(margin(wrong) < 0);
  CHECK(margin(most) == Approx(0.5));
  CHECK(decisive({&middle, &edge, &small}) == &edge);
  CHECK(decisive({&edge, &wrong}) == &wrong);
  CHECK(decisive({&edge, &none, &wrong}) == &none);
  CHECK(decisive({&counted, &middle}) == &middle);
  CHECK(decisive({&counted}) == &counted);
  CHECK(decisive({}) == nullptr);
}

TEST_CASE("a headline is red when one of its checks is", "[reports]") {
  ReportData data;
  data.results = sample_results();
  data.results.headlines = {{"Orders", "poiseuille-space", "order of", ""}, {"Absent", "nobody", "", ""}};
  const auto headlines = headlines_of(data, 6);
  REQUIRE(headlines.size() == 2);  // the second is a study that no headline names
  CHECK(headlines[0].title == "Orders");
  CHECK_FALSE(headlines[0].holds);
  CHECK(headlines[0].checks == 2);
  CHECK(headlines[0].highest == 2.050003);
  CHECK(headlines[1].study == "poiseuille-time");
}

TEST_CASE("a headline of checks with several bands shows the one that is nearest to its own", "[reports]") {
  ReportData data;
  data.results.studies.resize(1);
  data.results.studies[0].study = "s";
  data.results.checks = {check_of("s", 3.9, 3.8, 4.2), check_of("s", 3.2, 3.15, 3.6)};
  data.results.headlines = {{"Orders", "s", "", ""}};
  const auto headlines = headlines_of(data, 1);
  REQUIRE(headlines.size() == 1);
  CHECK_FALSE(headlines[0].one_band);
  CHECK(headlines[0].lowest == 3.2);
  CHECK(headlines[0].highest == 3.2);
  data.results.checks[1] = check_of("s", 4.0, 3.8, 4.2);
  CHECK(headlines_of(data, 1)[0].one_band);
  CHECK(headlines_of(data, 1)[0].highest == 4.0);
}

TEST_CASE("a figure inside the page keeps its lines, marks and texts", "[reports]") {
  if (!Gnuplot().available()) return;
  ScratchDirectory dir;
  write_sample(dir.path());
  write_report(dir.path());
  const std::string svg = read_file(dir / "figures/poiseuille-order.svg");
  const std::string inlined = inline_svg(svg, "a \"label\" <x>");
  CHECK(inlined.starts_with("<svg role=\"img\" aria-label=\"a &quot;label&quot; &lt;x&gt;\""));
  CHECK(inlined.ends_with("</svg>"));
  CHECK(inlined.size() < svg.size() / 2);
  // gnuplot's own marks: one `use` a point, one `text` a label; definitions are shared by the page.
  const std::string drawn = svg.substr(svg.find("</defs>"));
  CHECK(count(inlined, "<use ") == count(drawn, "<use "));
  CHECK(count(inlined, "<text") == count(drawn, "<text"));
  CHECK(count(inlined, "<path ") == count(drawn, "<path "));
  CHECK(count(inlined, " id=") == 0);
  const std::string marks = svg_marks();
  for (int mark = 0; mark <= 14; ++mark) CHECK(count(marks, fmt::format("id=\"Pt{}\"", mark)) == 1);
  CHECK(inline_svg("no image", "x").empty());
  CHECK(inline_svg("<svg viewBox=\"0 0 1 1\"><g>", "x").empty());
}

TEST_CASE("a run of one mark is said as a group, and nothing else changes", "[reports]") {
  const std::string mark = R"svg(<use href="#Pt6" transform="translate(40,20)scale(4)" color="#0072b2"/>)svg";
  const std::string other = R"svg(<use href="#Pt5" transform="translate(8,4)scale(4)" color="#0072b2"/>)svg";
  CHECK(
      gathered_marks("<g>" + mark + mark + other + "</g><use id=\"a\"/>") ==
      R"svg(<g><g transform="scale(4)" color="#0072b2"><use href="#Pt6" x="10" y="5"/><use href="#Pt6" x="10" y="5"/></g>)svg"
      R"svg(<g transform="scale(4)" color="#0072b2"><use href="#Pt5" x="2" y="1"/></g></g><use id="a"/>)svg");
}

TEST_CASE("a figure of no study is no study", "[reports]") {
  ReportData data;
  data.results = sample_results();
  const std::size_t studies = studies_of(data.results).size();
  FigureRecord of_a_chapter;
  of_a_chapter.figure = of_a_chapter.kind = "computed-measured";
  data.results.figures.push_back(of_a_chapter);
  CHECK(studies_of(data.results).size() == studies);
}

TEST_CASE("a page shows every failure, and thirty-six of the checks of a study that hold", "[reports]") {
  std::vector<CheckRecord> records;
  for (int i = 0; i < 200; ++i)
    records.push_back(check_of(fmt::format("study-{}", i), i % 2 == 0 ? 2 : 0.5, 0, 1));
  std::vector<const CheckRecord*> checks;
  for (const CheckRecord& record : records) checks.push_back(&record);
  const std::string table = html_checks(checks, false);
  CHECK(count(table, ">FAIL<") == 100);
  CHECK(count(table, ">pass<") == 36);
  CHECK_THAT(table, contains("64 more, which hold, in checks.csv"));
  CHECK(table.find(">FAIL<") < table.find(">pass<"));
}

TEST_CASE("a summary stays below its limit whatever fails, and shows failures first", "[reports]") {
  ReportData data;
  data.results = sample_results();
  std::string text = markdown_summary(data);
  CHECK(text.starts_with("# FAIL: 3 of 5"));
  CHECK(text.find("## Failures") < text.find("## Topics"));
  CHECK_THAT(text, contains("&lt;4 nodes&gt;"));
  for (int i = 0; i < 5000; ++i) {
    data.results.checks.push_back(check_of(fmt::format("study-{}", i), 2, 0, 1));
    data.results.checks.back().reason = std::string(3000, '|') + "é";
    data.results.studies.push_back({fmt::format("study-{}", i), "t", "", "", "", fmt::format("topic {}", i)});
    data.warnings.push_back(std::string(2000, 'w'));
  }
  text = markdown_summary(data);
  CHECK(text.size() < summary_limit);
  CHECK_THAT(text, contains("more failures in checks.csv"));
}

TEST_CASE("what changed since the results that lay there before", "[reports]") {
  ScratchDirectory dir;
  EarlierRun(dir.path()).write_changes();
  CHECK_FALSE(read_changes(dir.path()).has_value());
  CHECK_THAT(changes_line(std::nullopt), contains("nothing to compare with"));

  write_sample(dir.path());
  const EarlierRun same(dir.path());
  same.write_changes();
  CHECK_THAT(changes_line(read_changes(dir.path())),
             contains("nothing is different from the run of 2026-01-02"));

  Results results = sample_results();
  results.checks[0].observed = 3;
  results.checks[0].verdict = "fail";
  results.errors[0].l2 *= 2;
  results.timings[0].wall_s *= 10;  // noise
  const EarlierRun earlier(dir.path());
  write_results(dir.path(), results);
  earlier.write_changes();
  const auto changes = read_changes(dir.path());
  REQUIRE(changes.has_value());
  CHECK(changes->size() == 3);
  CHECK_THAT(changes_line(changes), contains("2 worse than in the run of"));
}

TEST_CASE("points are named after who made them", "[reports]") {
  ScratchDirectory dir;
  write_sample(dir.path());
  Results results = sample_results();
  for (RunRecord& run : results.runs) run.method = "their-solver";
  const Figure profiles = build_figure(dir.path(), results.figures[0], results);
  CHECK_THAT(profiles.script, contains("their-solver, grid nodes"));
  CHECK(profiles.script.find("MPM") == std::string::npos);
  const Figure history = build_figure(dir.path(), results.figures[1], results);
  CHECK_THAT(history.script, contains("10 cells, their-solver"));
  CHECK(history.caption.find("MPM") == std::string::npos);
}
