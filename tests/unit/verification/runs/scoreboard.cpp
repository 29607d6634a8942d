#include <cmath>
#include <limits>

#include "tests/study_text.hpp"
#include "tests/unit/verification/read_text.hpp"
#include "verification/checks/chatter_check.hpp"
#include "verification/checks/check_reader.hpp"
#include "verification/config/config_error.hpp"
#include "verification/reading/scoreboard_reader.hpp"
#include "verification/runs/scores.hpp"

using namespace verification;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

const std::string good =
    study_text("T", "C", couette_scene("cells = 8", "dt = 1e-3\noutputs = [0.02]") + R"([matrix]
basis = ["linear", "cubic"]
transfer = ["flip", "pic"]
stepping = ["usf"]
[[variant]]
name = "blend"
scheme = { transfer = "flip-blend" }
[scoreboard]
case = "plate"
degraded_above = 0.1
energy_ratio = [0.5, 1.5]
reason = "ten percent"
in_full = ["linear_pic_usf", "blend"]
in_quick = ["linear_flip_usf"]
[[expect]]
outcome = "survived"
reason = "stable"
[[expect]]
transfer = ["pic"]
outcome = "degraded"
reason = "loses"
[[expect]]
basis = ["cubic"]
transfer = ["pic"]
outcome = "diverged"
reason = "made up"
)",
               "suite = \"deep\"\n");

std::string with(const std::string& from, const std::string& to) {
  return replaced(good, from, to);
}

Study read(const std::string& text) {
  return read_study_text(text, "board-test");
}

/// A run of the study's first scheme that ended with an error and an energy ratio.
RunData ended(const Study& study, double error, double energy, const std::string& status = "completed") {
  RunData run;
  run.plan = &study.runs.front();
  run.record.run = run.plan->run;
  run.record.status = status;
  run.errors = {{run.plan->run, 0.02, "grid", error, error, error}};
  const double v = std::sqrt(energy);
  run.profile = {{0.02, "particles", 0, 0, v, 0, 1, 0}, {0.02, "particles", 0, 1e-4, 0, 2 * v, 0, 2}};
  return run;
}

std::string outcome_of(const Study& study, const RunData& run) {
  return score_of(run, study).outcome;
}

}  // namespace

TEST_CASE("a scoreboard expects something of every scheme, the last pattern that takes it in") {
  const Study study = read(good);
  REQUIRE(study.runs.size() == 5);
  const auto& expected = study.scoreboard->expected;
  CHECK(expected.at("linear_flip_usf").fate == Fate::Survived);
  CHECK(expected.at("blend").fate == Fate::Survived);
  CHECK(expected.at("linear_pic_usf").fate == Fate::Degraded);
  CHECK(expected.at("cubic_pic_usf").fate == Fate::Diverged);
  CHECK(expected.at("cubic_pic_usf").reason == "made up");
  REQUIRE(study.checks.size() == 1);
  CHECK(study.checks.front().kind == "outcome");
}

TEST_CASE("a scoreboard that leaves something open is refused with file, key and remedy") {
  const auto refused = [](const std::string& text, const std::string& names) {
    CHECK_THROWS_AS(read(text), ConfigError);
    CHECK_THROWS_WITH(read(text), contains("board-test.toml"));
    CHECK_THROWS_WITH(read(text), contains(names));
  };
  refused(with("[[expect]]\noutcome = \"survived\"\nreason = \"stable\"\n", ""),
          "'linear_flip_usf'; add an [[expect]]");
  refused(with("transfer = [\"pic\"]\noutcome", "transfer = [\"pik\"]\noutcome"),
          "'pik' is not known; choose from: flip, pic");
  refused(with("outcome = \"degraded\"", "outcome = \"worse\""), "outcome");
  refused(with("reason = \"loses\"", "reason = \" \""), "reason");
  refused(with("reason = \"ten percent\"", ""), "reason");
  refused(with("basis = [\"cubic\"]\n", "basis = [\"quadratic\"]\n"), "no scheme");
  refused(with("in_quick = [\"linear_flip_usf\"]", "in_quick = [\"linear_flip\"]"), "'linear_flip'");
  refused(with("degraded_above = 0.1", "degraded_above = 20"), "degraded_above");
  refused(with("[0.5, 1.5]", "[1.1, 1.5]"), "energy_ratio");
  refused(with("[scoreboard]", "[ladder]\naxis = \"space\"\ncells = [4, 8]\ntheoretical = 2\n[scoreboard]"),
          "ladder");
  refused(good.substr(0, good.find("[scoreboard]")) + good.substr(good.find("[[expect]]")), "[scoreboard]");
  refused(good + "[[check]]\nkind = \"outcome\"\nreason = \"r\"\n", "comes with a [scoreboard]");
}

TEST_CASE("a lesser suite runs the schemes that a scoreboard names for it, and those below") {
  Study quick = read(good), full = read(good), deep = read(good);
  REQUIRE(restrict_to(quick, Suite::Quick));
  REQUIRE(quick.runs.size() == 1);
  CHECK(quick.variants == std::vector<std::string>{"linear_flip_usf"});
  CHECK(quick.checks.front().variants == quick.variants);
  REQUIRE(restrict_to(full, Suite::Full));
  CHECK(full.runs.size() == 3);
  REQUIRE(restrict_to(deep, Suite::Deep));
  CHECK(deep.runs.size() == 5);
  Study none = read(with("in_quick = [\"linear_flip_usf\"]\n", ""));
  CHECK_FALSE(restrict_to(none, Suite::Quick));
}

TEST_CASE("what became of a run: its error, its energy, its end") {
  const Study study = read(good);
  CHECK(outcome_of(study, ended(study, 0.09, 1.0)) == "survived");
  CHECK(outcome_of(study, ended(study, 0.11, 1.0)) == "degraded");
  CHECK(outcome_of(study, ended(study, 0.09, 0.4)) == "degraded");
  CHECK(outcome_of(study, ended(study, 0.09, 1.6)) == "degraded");
  CHECK(outcome_of(study, ended(study, 11, 1.0)) == "diverged");
  CHECK(outcome_of(study, ended(study, not_a_number, 1.0)) == "diverged");
  CHECK(energy_ratio(ended(study, 0, 0.49), 0.02) == Approx(0.49).epsilon(1e-14));

  RunData broken =
      ended(study, not_a_number, not_a_number, "diverged at t = 0.004 s: velocity is not finite");
  CHECK(score_of(broken, study).t_diverged == 0.004);
  // Kinetic energies [J/m] of 1 kg/m: the scale is 1e-4 m/s, ten of which are 5e-7 J/m.
  reports::HistoryRow row;
  row.mass = 1;
  for (const double energy : {0.0, 1e-8, 6e-7, 1e3}) {
    row.kinetic_energy = energy;
    broken.history.push_back(row);
    row.t += 1e-3;
  }
  CHECK(time_of_divergence(broken) == Approx(2e-3).epsilon(1e-12));
  CHECK(score_of(broken, study).outcome == "diverged");
  // Who blew up on the way has diverged, even if the end looks like the exact solution.
  RunData back = ended(study, 0.09, 1.0);
  back.history = broken.history;
  CHECK(score_of(back, study).outcome == "diverged");
  CHECK(score_of(back, study).t_diverged == Approx(2e-3).epsilon(1e-12));
  back.history.resize(2);
  CHECK(score_of(back, study).outcome == "survived");

  const reports::ScoreRecord failed = score_of(ended(study, 0, 1, "failed: no such thing"), study);
  CHECK(failed.outcome == "failed");
  CHECK(failed.verdict == "fail");
}

TEST_CASE("a fluid at rest has no energy ratio: without a band its error alone judges") {
  const Study study = read(with("energy_ratio = [0.5, 1.5]\n", "")), band = read(good);
  const auto at_rest = [](const Study& s, double error) {
    RunData run = ended(s, error, 1);
    for (reports::ProfileRow& row : run.profile) row.u_exact = row.v_exact = 0;
    return run;
  };
  CHECK(std::isnan(energy_ratio(at_rest(study, 0), 0.02)));
  CHECK(outcome_of(study, at_rest(study, 0.09)) == "survived");
  CHECK(outcome_of(study, at_rest(study, 0.11)) == "degraded");
  CHECK(outcome_of(study, at_rest(study, not_a_number)) == "diverged");
  CHECK(outcome_of(band, at_rest(band, 0.09)) == "degraded");
}

TEST_CASE("an unexpected failure is red, and so is an unexpected survival") {
  const auto verdict = [](const Study& study, const RunData& run) {
    Study of_one_run = study;
    of_one_run.runs.resize(1);
    StudyData data;
    data.study = &of_one_run;
    data.runs = {run};
    evaluate_checks(data);
    REQUIRE(data.checks.size() == 1);
    CHECK(data.checks[0].unit == reports::outcome_unit);
    return data.checks[0].verdict;
  };
  const Study survives = read(good);
  const Study diverges = read(with("outcome = \"survived\"", "outcome = \"diverged\""));
  const std::string broken = "diverged at t = 0.004 s: velocity is not finite";
  CHECK(verdict(survives, ended(survives, 0.01, 1)) == "pass");
  CHECK(verdict(survives, ended(survives, 0.2, 1)) == "fail");
  CHECK(verdict(survives, ended(survives, not_a_number, not_a_number, broken)) == "fail");
  CHECK(verdict(diverges, ended(diverges, not_a_number, not_a_number, broken)) == "pass");
  CHECK(verdict(diverges, ended(diverges, 0.2, 1)) == "fail");
  CHECK(verdict(diverges, ended(diverges, 0.01, 1)) == "fail");
  CHECK(verdict(diverges, ended(diverges, 0.01, 1, "failed: no such thing")) == "fail");
}

TEST_CASE("chatter: the critical shear rate, and which cells swing") {
  // n nu_0 gdot^(n-1) dt/h^2 = r at the critical rate.
  const double rate = critical_shear_rate(1.5, 1e-4, 1e-3, 1e-6, 0.4);
  CHECK(0.4 * 1e-6 * std::pow(rate, -0.6) * 1e-3 / 1e-8 == Approx(1.5).epsilon(1e-12));

  RunData calm, run;
  for (int j = 0; j < 6; ++j) {
    calm.shear.push_back({1.0, "cells", 0.1 * j, 1.0 * j, 1});
    // A smooth offset, and a swing of 0.4 between cells 0 and 2.
    run.shear.push_back({1.0, "cells", 0.1 * j, 1.0 * j + 0.5 + 0.1 * j + (j == 1 ? 0.4 : 0), 1});
  }
  CHECK(chattering_shear_rate(run, calm, 1.0, 0.15) == 1);  // |d''|/4: 0.2 in cell 1, 0.1 in cell 2
  CHECK(chattering_shear_rate(run, calm, 1.0, 0.05) == 2);
  CHECK(chattering_shear_rate(run, calm, 1.0, 0.25) == 0);
  CHECK(std::isnan(chattering_shear_rate(run, calm, 2.0, 0.25)));
}
