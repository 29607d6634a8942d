#include <cmath>
#include <numbers>

#include "tests/study_text.hpp"
#include "tests/unit/verification/read_text.hpp"
#include "verification/checks/check_reader.hpp"
#include "verification/checks/expected_checks.hpp"
#include "verification/config/config_error.hpp"
#include "verification/runs/measures.hpp"

using namespace verification;

namespace {

const std::string error_check =
    "[[check]]\nkind = \"error\"\nlocations = [\"grid\"]\ntimes = [0.1]\nupper = 1\nreason = \"r\"\n";

/// The check of a Couette run (1e-4 m/s) that is off by 2e-6 m/s where the exact solution moves at `exact`.
reports::CheckRecord judged(const std::string& key, double exact) {
  const Study study = read_study_text(study_text("T", "C", couette_scene() + error_check + key));
  StudyData data;
  data.study = &study;
  RunData run;
  run.plan = &study.runs.front();
  run.record.run = run.plan->run;
  run.record.status = "completed";
  run.profile = {{0.1, "grid", 0, 0, exact + 2e-6, 0, exact, 0}};
  run.errors = measure_errors(run);
  CHECK(run.errors.front().scale == 1e-4);
  if (!std::isnan(exact)) CHECK(run.errors.front().exact_max == exact);
  data.runs = {run};
  evaluate_checks(data);
  return data.checks.front();
}

auto about(double value) {
  return Catch::Matchers::WithinRel(value, 1e-9);
}

}  // namespace

TEST_CASE("an error is relative to what its check says", "[scale]") {
  CHECK_THAT(judged("", 1e-5).observed, about(0.02));
  CHECK_THAT(judged("relative_to = \"steady\"\n", 1e-5).observed, about(0.02));
  CHECK_THAT(judged("relative_to = \"present\"\n", 1e-5).observed, about(0.2));
  CHECK_THAT(judged("relative_to = 4e-6\n", 1e-5).observed, about(0.5));
  CHECK(std::isnan(judged("relative_to = \"present\"\n", std::nan("")).observed));
  CHECK_THAT(judged("relative_to = 4e-6\n", 1e-5).reason, contains("relative to 4e-06 m/s"));
  for (const char* wrong : {"relative_to = \"past\"\n", "relative_to = 0\n", "relative_to = -1\n"})
    CHECK_THROWS_AS(judged(wrong, 1e-5), ConfigError);
}

TEST_CASE("the error of a flow that decays is relative to its speed at that time", "[scale]") {
  const Study study = read_study_text(R"(title = "T"
claim = "C"
[scene]
flow = "taylor-green"
period = 1.0
amplitude = 2.0
[fluid]
kinematic_viscosity = 0.01
bulk_modulus = 6e4
density = 1000.0
[discretisation]
cells = 8
[time]
dt = 1e-3
outputs = [0.5, 1.0]
[[check]]
kind = "error"
locations = ["grid"]
upper = 1
reason = "r"
)");
  RunData run;
  run.plan = &study.runs.front();
  run.profile = {{0.5, "grid", 0, 0, 1e-3, 0, 0, 0}, {1, "grid", 0, 0, 1e-3, 0, 0, 0}};
  const auto errors = measure_errors(run);
  REQUIRE(errors.size() == 4);  // two places, the particles' are missing
  for (const auto& error : {errors[0], errors[2]}) {
    const double speed = std::sqrt(2.0) * std::exp(-2 * 0.01 * std::pow(2 * std::numbers::pi, 2) * error.t);
    CHECK_THAT(error.scale, about(speed));
    CHECK_THAT(error.l2, about(1e-3 / speed));
  }
}

TEST_CASE("a scale more than three times what flows is a warning", "[scale]") {
  CHECK_THAT(judged("", 1e-4 / 3.1).reason, contains("warning: relative to 0.0001 m/s, 3.1 times"));
  CHECK(judged("", 1e-4 / 2.9).reason == "r");
  // Who names the scale knows it.
  CHECK(judged("relative_to = \"steady\"\n", 1e-5).reason == "r");
}

TEST_CASE("checks that were to be made and were not fail the study", "[scale]") {
  Study study = read_study_text(study_text("T", "C", couette_scene() + error_check, "expected_checks = 2\n"));
  REQUIRE(expected_checks(study) == 2);
  const auto made = [&](const std::vector<reports::CheckRecord>& before) {
    StudyData data;
    data.study = &study;
    data.checks = before;
    require_all_checks(data);
    return data.checks;
  };
  const reports::CheckRecord check{study.name, "c", 0, 0, 0, "1", "pass", "r"};
  CHECK(made({check, check}).size() == 2);
  CHECK(made({check}).back().verdict == "fail");
  CHECK(made({check, check, check}).back().observed == 3);
  study.declared_checks.reset();  // as where a lesser suite runs a part: the number follows from the checks
  CHECK(made({check}).back().verdict == "fail");
  CHECK(made({check, check}).size() == 2);
  CHECK_THROWS_AS(
      read_study_text(study_text("T", "C", couette_scene() + error_check, "expected_checks = 3\n")),
      ConfigError);
}

TEST_CASE("a run that did not complete fails its study, whatever its errors", "[scale]") {
  const Study study = read_study_text(study_text("T", "C", couette_scene() + error_check));
  for (const char* status : {"completed", "diverged at t = 1 s: too fast", "failed: no such thing"}) {
    StudyData data;
    data.study = &study;
    RunData run;
    run.plan = &study.runs.front();
    run.record.run = run.plan->run;
    run.record.status = status;
    data.runs = {run};
    evaluate_checks(data);
    REQUIRE(data.checks.back().check == "runs that did not complete");
    CHECK((data.checks.back().verdict == "pass") == (status == std::string("completed")));
  }
}
