#include "verification/suite/shown_failures.hpp"

#include <cmath>

#include "reports/pages/console_table.hpp"
#include "reports/pages/report.hpp"
#include "reports/records/directory/result_files.hpp"
#include "tests/scratch_directory.hpp"
#include "tests/study_text.hpp"

using namespace verification;

namespace {

reports::Results results_with(int held, int failed) {
  reports::Results results;
  results.studies = {{"s", "S", "c", "quick"}};
  for (int k = 0; k < held + failed; ++k)
    results.checks.push_back({"s", "check " + std::to_string(k), k < held ? 0.0 : 2.0, 0, 1, "1",
                              k < held ? "pass" : "fail", "r"});
  return results;
}

/// What the pages of these results show; `spoilt` is a file whose text is changed before.
std::vector<Shown> shown(const reports::Results& results, const std::string& spoilt = "",
                         const std::string& from = "", const std::string& to = "") {
  const ScratchDirectory scratch;
  reports::write_results(scratch.path(), results);
  reports::write_report(scratch.path());
  std::string console = reports::console_table(results.checks, false, 0);
  if (spoilt == "console")
    console = replaced(console, from, to);
  else if (!spoilt.empty())
    scratch.write(spoilt, replaced(content_of(scratch.path() / spoilt), from, to));
  return shown_failures(scratch.path(), console, results);
}

}  // namespace

TEST_CASE("every page shows as many failures as there are", "[control]") {
  for (const auto& [held, failed] : {std::pair{3, 0}, {2, 1}, {0, 3}, {1, 12}})
    for (const Shown& one : shown(results_with(held, failed))) {
      INFO(one.where << ": " << held << " hold, " << failed << " fail");
      CHECK(one.failures == failed);
    }
}

TEST_CASE("a page that hides a failure, or whose verdict does not fit, is found out", "[control]") {
  const reports::Results results = results_with(2, 2);
  const auto of = [&](std::size_t which, const std::string& file, const std::string& from,
                      const std::string& to) { return shown(results, file, from, to)[which].failures; };
  CHECK(of(0, "console", "\nFAIL  s", "\npass  s") == 1);
  CHECK(std::isnan(of(0, "console", "FAIL: 2 of 4", "PASS: 4 of 4")));
  CHECK(std::isnan(of(1, "junit.xml", "failures=\"2\"", "failures=\"0\"")));
  CHECK(std::isnan(of(1, "junit.xml", "<failure ", "<skipped ")));
  CHECK(of(2, "summary.md", "\n| s | check 3 |", "\n") == 1);
  CHECK(std::isnan(of(2, "summary.md", "# FAIL", "# PASS")));
  CHECK(of(3, "report.md", "| **FAIL** |", "| pass |") == 1);
  CHECK(of(4, "report.html", "<td class=\"fail\">FAIL</td>", "<td>FAIL</td>") == 1);
  CHECK(std::isnan(of(4, "report.html", "banner fail", "banner pass")));
}

TEST_CASE("what could not be judged is an error in JUnit, not a failure", "[control]") {
  reports::Results results = results_with(1, 2);
  results.checks.back().observed = std::nan("");
  const ScratchDirectory scratch;
  reports::write_results(scratch.path(), results);
  reports::write_report(scratch.path());
  const std::string junit = content_of(scratch.path() / "junit.xml");
  CHECK(count(junit, "tests=\"3\" failures=\"1\" errors=\"1\"") == 2);
  CHECK(count(junit, "<error type=\"not judged\"") == 1);
  CHECK(shown(results)[1].failures == 2);
}
