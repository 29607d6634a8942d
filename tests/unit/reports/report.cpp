#include "reports/pages/report.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <regex>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/drawing/gnuplot.hpp"
#include "reports/figures/figures.hpp"
#include "reports/files/atomic_file.hpp"
#include "reports/files/io_error.hpp"
#include "reports/pages/console_table.hpp"
#include "reports/pages/html/page.hpp"
#include "reports/pages/junit.hpp"
#include "reports/pages/report_markdown.hpp"
#include "reports/records/directory/result_files.hpp"
#include "reports/records/provenance.hpp"
#include "reports/records/report_data.hpp"
#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"
#include "tests/unit/reports/sample.hpp"

using namespace reports;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::map<std::string, std::string> files_of(const std::filesystem::path& dir) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(dir)) {
    if (entry.is_regular_file())
      files[entry.path().lexically_relative(dir).string()] = read_file(entry.path());
  }
  return files;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + part.size())) ++times;
  return times;
}

// Whether tags nest and close as XML demands; enough of a parser for what we write.
bool tags_nest(std::string text, bool html) {
  text = std::regex_replace(text, std::regex("<!DOCTYPE[^>]*>|<\\?[^>]*\\?>"), "");
  if (const std::size_t script = text.find("<script>"); script != text.npos)
    text.erase(script + 8, text.find("</script>") - script - 8);
  std::vector<std::string> open;
  for (std::size_t at = text.find('<'); at != text.npos; at = text.find('<', at + 1)) {
    const std::size_t end = text.find('>', at);
    if (end == text.npos) return false;
    const std::string tag = text.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(tag[0] == '/', tag.find_first_of(" /\n", 1) - (tag[0] == '/'));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    } else if (tag.back() != '/' && !(html && (name == "meta" || name == "link" || name == "input"))) {
      open.push_back(name);
    }
  }
  return open.empty();
}

bool gnuplot_is_here() {
  return Gnuplot().available();
}

}  // namespace

TEST_CASE("a report without gnuplot is complete but for the figures", "[reports]") {
  ScratchDirectory dir;
  write_sample(dir.path());
  const EnvironmentVariable none("MPM_GNUPLOT", "/nonexistent/gnuplot");
  const ReportOutcome outcome = write_report(dir.path());
  CHECK(outcome.checks_passed == 3);
  CHECK(outcome.checks_failed == 2);
  CHECK_FALSE(outcome.passed);
  REQUIRE(outcome.warnings.size() == 1);
  CHECK_THAT(outcome.warnings[0],
             contains("5 of 5 figures not drawn: /nonexistent/gnuplot is not installed"));
  for (const char* file : {"report.md", "report.html", "junit.xml", "figures/poiseuille-order.gp"}) {
    CHECK(std::filesystem::file_size(dir / file) > 0);
  }
  CHECK_THAT(read_file(dir / "report.md"), contains("is not installed"));
}

TEST_CASE("a gnuplot that fails is reported once with what it said", "[reports]") {
  ScratchDirectory dir;
  write_sample(dir.path());
  write_file(dir / "broken", "#!/bin/sh\necho 'no terminal today' >&2\nexit 3\n");
  std::filesystem::permissions(dir / "broken", std::filesystem::perms::owner_all);
  const EnvironmentVariable broken("MPM_GNUPLOT", (dir / "broken").string());
  const ReportOutcome outcome = write_report(dir.path());
  REQUIRE(outcome.warnings.size() == 1);
  CHECK_THAT(outcome.warnings[0], contains("exit code 3"));
  CHECK_THAT(outcome.warnings[0], contains("no terminal today"));
}

TEST_CASE("the same tables give the same bytes", "[reports]") {
  if (!gnuplot_is_here()) WARN("gnuplot is not installed: the images are not compared");
  ScratchDirectory one, two;
  write_sample(one.path());
  const ReportOutcome outcome = write_report(one.path());
  if (gnuplot_is_here()) CHECK(outcome.warnings.empty());
  const auto first = files_of(one.path());
  write_report(one.path());
  CHECK(files_of(one.path()) == first);
  // Elsewhere and from nothing, so that no image can be a left-over.
  write_sample(two.path());
  write_report(two.path());
  CHECK(files_of(two.path()) == first);
  for (const auto& [name, content] : first) CHECK(name.find(".part") == name.npos);
  if (gnuplot_is_here()) {
    CHECK(first.count("figures/poiseuille-profiles.svg") == 1);
    CHECK(first.at("figures/work-precision.png").substr(1, 3) == "PNG");
    CHECK(count(first.at("report.html"), "<svg id=\"fig-") == 5);
  }
}

TEST_CASE("a changed table redraws its figure and no other", "[reports]") {
  if (!gnuplot_is_here()) return;
  ScratchDirectory dir;
  write_sample(dir.path());
  write_report(dir.path());
  const auto before = files_of(dir.path());
  Results results = sample_results();
  for (TimingRecord& timing : results.timings) timing.wall_s *= 3;
  write_results(dir.path(), results);
  write_report(dir.path());
  const auto after = files_of(dir.path());
  CHECK(after.at("figures/work-precision.svg") != before.at("figures/work-precision.svg"));
  CHECK(after.at("figures/poiseuille-order.svg") == before.at("figures/poiseuille-order.svg"));
}

TEST_CASE("failures come first and texts are literal", "[reports]") {
  ReportData data;
  data.results = sample_results();
  SECTION("markdown") {
    const std::string text = markdown_report(data);
    CHECK(text.substr(0, text.find('\n')) == "# FAIL: 3 of 5 checks hold");
    CHECK(text.find("**FAIL**") < text.find("| pass |"));
    CHECK(text.find("<4 nodes>") == text.npos);
    CHECK_THAT(text, contains("&lt;4 nodes&gt; \\| band"));
    CHECK_THAT(text, contains("cubic.cells=80"));
    CHECK_THAT(text, contains("diverged at t = 0.0123 s"));
  }
  SECTION("junit") {
    const std::string text = junit_report(data.results);
    CHECK(tags_nest(text, false));
    CHECK_THAT(text, contains("<testsuites name=\"mpm-verify\" tests=\"5\" failures=\"1\" errors=\"1\""));
    CHECK(count(text, "<failure ") == 1);
    CHECK(count(text, "<error ") == 1);  // nothing was observed
    CHECK(count(text, "<testcase ") == 5);
    CHECK_THAT(text, contains("&lt;4 nodes&gt;"));
  }
  SECTION("html") {
    ScratchDirectory dir;
    write_sample(dir.path());
    const EnvironmentVariable none("MPM_GNUPLOT", "/nonexistent/gnuplot");
    write_report(dir.path());
    const std::string text = read_file(dir / "report.html");
    CHECK(tags_nest(text, true));
    const std::string screen = text.substr(text.find("<main"));
    CHECK(screen.find("FAIL: 3 of 5") < screen.find("id=\"failures\""));
    CHECK(screen.find("id=\"failures\"") < screen.find("class=\"headlines\""));
    CHECK(screen.find("class=\"headlines\"") < screen.find("class=\"chapter\""));
    CHECK(text.find("<usf>") == text.npos);
    CHECK_THAT(text, contains("&lt;usf&gt;"));
    CHECK(count(text, "http") == 0);  // no external resource
  }
  SECTION("console") {
    const std::string text = console_table(data.results.checks, false);
    CHECK(text.rfind("pass  ") < text.find("FAIL"));
    CHECK(text.find('\033') == text.npos);
    CHECK_THAT(console_table(data.results.checks, true), contains("\033["));
    CHECK_THAT(text, contains("bounds: mass is carried by particles"));
    CHECK_THAT(text, contains("FAIL: 3 of 5 checks hold"));
    data.results.checks[4].reason = std::string(300, 'x') + " \033[31m" + std::string(40, 'y');
    data.results.checks[4].check = std::string(200, 'z');
    std::size_t begin = 0;
    const std::string wide = console_table(data.results.checks, false);
    CHECK(wide.find('\033') == wide.npos);
    for (std::size_t end = wide.find('\n'); end != wide.npos; begin = end + 1, end = wide.find('\n', begin)) {
      CHECK(end - begin <= 110);
    }
  }
}

TEST_CASE("a verdict is not believed against its numbers", "[reports]") {
  CHECK(holds({"s", "c", 1, 1, 1, "", "pass", ""}));
  CHECK_FALSE(holds({"s", "c", 2, 0, 1, "", "pass", ""}));
  CHECK_FALSE(holds({"s", "c", not_a_number, 0, 1, "", "pass", ""}));
  CHECK_FALSE(holds({"s", "c", 0.5, 0, 1, "", "fail", ""}));
  Results nothing;
  CHECK_FALSE(passed(nothing));
  CHECK(verdict_line(nothing) == "FAIL: no check was made");

  ScratchDirectory dir;
  Results results;
  results.checks = {{"s", "liar", 2, 0, 1, "", "pass", "r"}};
  write_results(dir.path(), results);
  const ReportOutcome outcome = write_report(dir.path());
  CHECK(outcome.checks_failed == 1);
  REQUIRE(outcome.warnings.size() == 2);
  CHECK_THAT(outcome.warnings[0], contains("'liar' (s) contradicts its numbers"));
  CHECK_THAT(outcome.warnings[1], contains("no provenance.json"));
}

TEST_CASE("numbers are printed so that a failure can be seen", "[reports]") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(observed({"s", "c", 2.050003, 1.95, 2.05, "", "fail", ""}) == "2.050003");
  CHECK(observed({"s", "c", 2.0012345, 1.95, 2.05, "", "pass", ""}) == "2.001");
  CHECK(observed({"s", "c", not_a_number, 1.95, 2.05, "", "fail", ""}) == "nan");
  CHECK(bounds({"s", "c", 1, -infinity, 2e-3, "", "pass", ""}) == "at most 0.002");
  CHECK(bounds({"s", "c", 1, 3, infinity, "", "pass", ""}) == "at least 3");
  CHECK(bounds({"s", "c", 1, 1.95, 2.05, "", "pass", ""}) == "1.95 to 2.05");
}

TEST_CASE("rates stand beside errors, the first one is empty", "[reports]") {
  Results results;
  for (const int i : {2, 0, 1}) {  // in no order
    results.levels.push_back({"s", "v", "space", "grid", "l2", 1, 0.1 / (1 << i), 0.8 / (1 << 3 * i), i < 2});
    results.levels.push_back({"s", "v", "space", "grid", "linf", 1, 0.1 / (1 << i), 1, true});
  }
  const auto tables = rate_tables(results, "s");
  REQUIRE(tables.size() == 1);
  REQUIRE(tables[0].rows.size() == 3);
  CHECK(tables[0].rows[0].step == 0.1);
  CHECK(rate(tables[0].rows[0].rates[0]) == "-");
  // Errors fall by exactly 8 a halving; two logarithms and a division round by a few 1e-16 each.
  CHECK(std::abs(tables[0].rows[1].rates[0] - 3) < 1e-14);
  CHECK(std::abs(tables[0].rows[2].rates[0] - 3) < 1e-14);
  CHECK_FALSE(tables[0].rows[2].used[0]);
}

TEST_CASE("figures refuse what they cannot draw", "[reports]") {
  ScratchDirectory dir;
  write_sample(dir.path());
  Results results = sample_results();
  FigureRecord record = results.figures[0];
  record.kind = "pie";
  CHECK_THROWS_WITH(build_figure(dir.path(), record, results), contains("unknown kind 'pie'"));
  record = results.figures[0];
  record.runs = "nobody";
  CHECK_THROWS_WITH(build_figure(dir.path(), record, results),
                    contains("'nobody', which runs.csv does not have"));
  record = results.figures[1];
  record.labels = "one;two";
  CHECK_THROWS_WITH(build_figure(dir.path(), record, results), contains("2 labels for 3 runs"));
  std::filesystem::remove(dir / "profiles/poiseuille-space.cells=20.csv");
  CHECK_THROWS_WITH(build_figure(dir.path(), results.figures[0], results), contains("No such file"));
  results.levels.clear();
  CHECK(build_figure(dir.path(), results.figures[2], results).script.empty());
}

TEST_CASE("a profile shows one column of a full run", "[reports]") {
  ScratchDirectory dir;
  write_sample(dir.path());
  const Results results = sample_results();
  FigureRecord record = results.figures[0];
  record.location = "particles";
  const Figure figure = build_figure(dir.path(), record, results);
  // Ten blocks: an exact line and a column of 40 particles for each of five times; the run has 800 particles.
  CHECK(count(figure.script, " << END\n") == 10);
  CHECK(count(figure.script, "\n0.0125 ") == 5);
  CHECK(count(figure.script, "\n0.9875 ") == 5);
}

TEST_CASE("wrapping, thinning, encoding", "[reports]") {
  CHECK(wrap("aa bb  cc", 5) == "aa bb\ncc");
  CHECK(wrap("longword x", 3) == "longword\nx");
  Curve curve;
  for (int i = 0; i < 100; ++i) curve.emplace_back(i, i);
  CHECK(thinned(curve, 10).size() == 10);
  CHECK(thinned(curve, 10).back().first == 99);
  CHECK(xml_text("a<b>&\"'\x01\xff é") == "a&lt;b&gt;&amp;&quot;&#39;?? é");
  CHECK(html_anchor("a b/c") == "study-a-b-c");
}

TEST_CASE("provenance survives writing and reading", "[reports]") {
  ScratchDirectory dir;
  CHECK_FALSE(read_provenance(dir.path()).has_value());
  Provenance out;
  out.build = {"1.2", "abc", "cc \"9\"", "-O3", "Release"};
  out.machine = this_machine();
  out.command = "mpm-verify run \xff";
  out.started = utc_now();
  CHECK(out.machine.cores >= 1);
  CHECK(out.machine.memory_bytes > 0);
  CHECK(std::regex_match(out.started, std::regex("\\d{4}-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ")));
  write_provenance(dir.path(), out);
  const auto in = read_provenance(dir.path());
  REQUIRE(in.has_value());
  CHECK(in->build.compiler == out.build.compiler);
  CHECK(in->machine.cpu == out.machine.cpu);
  CHECK(in->machine.memory_bytes == out.machine.memory_bytes);
  CHECK(in->started == out.started);
  write_file(dir / "provenance.json", "{\"version\": 3}");
  CHECK_THROWS_AS(read_provenance(dir.path()), IoError);
  CHECK_THROWS_WITH(read_provenance(dir.path()), contains("provenance.json"));
}
