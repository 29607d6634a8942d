#include "reports/figures/drawing/gnuplot.hpp"
#include "reports/files/csv.hpp"
#include "reports/files/utf8.hpp"
#include "reports/pages/junit.hpp"
#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"

using namespace reports;

TEST_CASE("text cells are no formulas to a spreadsheet, and come back as they were") {
  struct Row {
    std::string text, behind;
  };
  constexpr auto columns = std::make_tuple(column("text", &Row::text), column("behind", &Row::behind));
  const std::vector<std::string> texts = {"=1+2",      "=HYPERLINK(\"x\",\"y\")",
                                          "@sum(a)",   "+cmd|' /C calc'!A0",
                                          "-x",        "'=1",
                                          "''=1",      "'plain'",
                                          "-1.5;2e-3", "-0.25",
                                          "nan",       "-nan",
                                          "plain",     "",
                                          "a=b",       "'"};
  std::vector<Row> rows;
  for (const std::string& text : texts) rows.push_back({text, "end"});
  const ScratchDirectory scratch;
  const std::string file = scratch.write("table.csv", csv_text(columns, rows));
  const std::string content = content_of(file);
  for (const char* begin : {"\n=", "\n@", "\n+", "\n-x", "\n\"="})
    CHECK(content.find(begin) == std::string::npos);
  CHECK(content.find("\n-1.5;2e-3,") != std::string::npos);  // numbers stay as they are
  CHECK(content.find("\n'plain',") != std::string::npos);
  const auto back = read_csv(file, columns);
  REQUIRE(back.size() == texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i) CHECK(back[i].text == texts[i]);
}

TEST_CASE("what would end an SVG's text early, or is no character, does not reach gnuplot") {
  CHECK(gnuplot_text("a]]>b").find("]]>") == std::string::npos);
  CHECK(gnuplot_text("x\xef\xbf\xbfy") == "\"x???y\"");
  CHECK(gnuplot_text("\xc3\xa9\xe2\x88\x9e") == "\"\xc3\xa9\xe2\x88\x9e\"");
  CHECK(gnuplot_text("\xff") == "\"?\"");
  CHECK(first_broken_byte("ab\xc3") == 2);
  CHECK(first_broken_byte("\xed\xa0\x80") == 0);  // a surrogate
  CHECK(first_broken_byte("caf\xc3\xa9") == std::string::npos);
}

TEST_CASE("JUnit: every case has a time, and they add up to that of their suite") {
  Results results;
  results.studies.push_back({"s", "S", "C", "quick", ""});
  RunRecord run;
  run.run = "s.a";
  run.study = "s";
  run.status = "completed";
  results.runs.push_back(run);
  TimingRecord timing;
  timing.run = "s.a";
  timing.wall_s = 3;
  results.timings.push_back(timing);
  for (const char* check : {"one", "two"}) results.checks.push_back({"s", check, 0, 0, 1, "1", "pass", "r"});
  results.checks.push_back({"s", "three", 2, 0, 1, "1", "fail", "r"});
  results.checks.push_back({"s", "four", 2, 0, 1, "1", "fail", "r"});
  const std::string junit = junit_report(results);
  std::size_t cases = 0;
  for (std::size_t at = 0; (at = junit.find("\" time=\"0.750000\"", at)) != std::string::npos; ++at) ++cases;
  CHECK(cases == 4);
  CHECK_THAT(junit, contains("failures=\"2\" errors=\"0\" skipped=\"0\" time=\"3.000000\""));
}
