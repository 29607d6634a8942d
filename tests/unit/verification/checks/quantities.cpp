#include "verification/checks/quantities/quantities.hpp"

#include <cmath>

#include "tests/catch.hpp"
#include "tests/study_text.hpp"
#include "tests/unit/verification/read_text.hpp"

using namespace verification;

TEST_CASE("energy drift is the largest change over the second half of a run that completed") {
  RunData run;
  run.record.status = "completed";
  // The first half, with its transient, does not count.
  const double energies[] = {0, 5, 2, 2.5, 1.5};
  for (int k = 0; k < 5; ++k) {
    reports::HistoryRow row;
    row.t = 0.1 * k;
    row.kinetic_energy = energies[k];
    run.history.push_back(row);
  }
  CHECK(evaluate({"energy-drift"}, run) == Approx(0.25).epsilon(1e-14));
  run.history.back().kinetic_energy = std::nan("");
  CHECK(std::isnan(evaluate({"energy-drift"}, run)));
  run.history.pop_back();
  run.record.status = "diverged at t = 0.4 s: velocity is not finite";
  CHECK(std::isnan(evaluate({"energy-drift"}, run)));
}

TEST_CASE("errors as quantities are those of their time and place, NaN where there is none") {
  RunData run;
  run.errors = {{"r", 0.1, "grid", 1, 2, 3}, {"r", 0.1, "particles", 4, 5, 6}, {"r", 0.2, "grid", 7, 8, 9}};
  CHECK(evaluate({"grid-error", 0.1}, run) == 2);
  CHECK(evaluate({"grid-error", 0.2}, run) == 8);
  CHECK(evaluate({"particle-error", 0.1}, run) == 5);
  CHECK(std::isnan(evaluate({"particle-error", 0.2}, run)));
  CHECK(needs_time("grid-error"));
  CHECK_FALSE(needs_time("energy-drift"));
}

TEST_CASE("the fewest and the most particles of a cell, NaN without particles or with one that is nowhere") {
  PlannedRun plan;
  plan.scene.scene.size = {2, 1};
  plan.scene.scene.cells = {2, 1};
  RunData run;
  run.plan = &plan;
  const double nan = std::nan("");
  for (const double x : {0.1, 0.9, 1.5, 2.0})  // the last stands on the wall
    run.profile.push_back({0.5, "particles", x, 0.5, 0, 0, nan, nan});
  run.profile.push_back({0.5, "particles", 0.2, 0.2, 0, 0, nan, nan});
  run.profile.push_back({0.5, "grid", 0.2, 0.2, 0, 0, nan, nan});
  CHECK(evaluate({"fewest-in-a-cell", 0.5}, run) == 2);
  CHECK(evaluate({"most-in-a-cell", 0.5}, run) == 3);
  CHECK(std::isnan(evaluate({"fewest-in-a-cell", 0.25}, run)));
  run.profile.front().x = nan;
  CHECK(std::isnan(evaluate({"most-in-a-cell", 0.5}, run)));
}

TEST_CASE("the settling time is that of the last time into the band, or the start where it never leaves") {
  const Study study = read_study_text(
      study_text("T", "C", couette_scene() + "[[check]]\nkind = \"error\"\nupper = 1\nreason = \"any\"\n"));
  RunData run;
  run.plan = &study.runs.front();
  const double steady = run.plan->scene.flow->steady_probe();
  const auto settles = [&](const std::vector<double>& off) {
    run.history.clear();
    for (std::size_t k = 0; k < off.size(); ++k) {
      reports::HistoryRow row;
      row.t = 0.1 * static_cast<double>(k);
      row.probe = steady * (1 + off[k]);
      run.history.push_back(row);
    }
    return evaluate({"settling-time"}, run);
  };
  // One percent is halfway from two percent to none; it has been there before.
  CHECK(settles({1, 0, 0.02, 0, 0}) == Approx(0.25).epsilon(1e-9));
  CHECK(settles({0, 0, 0, 0}) == 0);
  CHECK(std::isnan(settles({0, 0, 0, 0.02})));
}
