#include <cmath>

#include "tests/study_text.hpp"
#include "tests/unit/verification/read_text.hpp"
#include "verification/suite/run_control.hpp"

using namespace verification;

namespace {

Study control_study() {
  return read_study_text(study_text(
      "T", "C",
      couette_scene() + "[[check]]\nkind = \"error\"\nupper = 1\nreason = \"any\"\n[control]\nplanted = "
                        "\"p\"\n[[control.must_fail]]\ncheck = \"l2 error\"\nbecause = \"stalled\"\n"));
}

reports::CheckRecord check(const std::string& name, const char* verdict, const std::string& reason) {
  return {"s", name, verdict == std::string("pass") ? 0.0 : 2.0, 0, 1, "1", verdict, reason};
}

/// What is red of a control that finds these checks, on pages that show `shown` failures.
std::vector<std::string> red(const std::vector<reports::CheckRecord>& checks, double exit_code, double shown,
                             int claims = 0) {
  const Study study = control_study();
  reports::Results results;
  results.checks = checks;
  for (int k = 0; k < claims; ++k) results.claims.push_back({"c", "s", "", "", "", "", "", false});
  std::vector<Shown> pages;
  for (const char* where : {"the console", "junit.xml", "summary.md", "report.md", "report.html"})
    pages.push_back({where, shown, static_cast<double>(claims)});
  const ControlOutcome outcome = judged_control(study, exit_code, results, pages, "");
  CHECK(outcome.checks.size() == study.control->expected_checks());
  std::vector<std::string> names;
  for (const reports::CheckRecord& one : outcome.checks)
    if (one.verdict != "pass") names.push_back(one.check);
  CHECK(outcome.record.seen == names.empty());
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("a control is seen when its checks are red for its reason, and nothing else is", "[control]") {
  const auto meant = check("l2 error, grid", "fail", "because it stalled");
  const auto held = check("order", "pass", "r");
  CHECK(red({meant, held}, 1, 1).empty());
  CHECK(red({meant, held}, 0, 1) == Names{"exit code"});
  CHECK(red({meant, held}, std::nan(""), 1) == Names{"exit code"});
  CHECK(red({meant, check("order", "fail", "r")}, 1, 2) == Names{"red without cause"});
  CHECK(red({check("l2 error, grid", "fail", "for another reason"), held}, 1, 1) ==
        Names{"red for it: l2 error", "red without cause"});
  CHECK(red({meant, meant}, 1, 2) == Names{"red for it: l2 error"});
  CHECK(red({}, 1, 0) == Names{"red for it: l2 error", "red without cause"});
  CHECK(red({meant, held}, 1, 1, 1) == Names{"claims that do not stand"});
  CHECK(red({meant, held}, 1, 0) == Names{"failures in the console", "failures in junit.xml",
                                          "failures in summary.md", "failures in report.md",
                                          "failures in report.html"});
}
