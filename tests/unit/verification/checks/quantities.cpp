#include "verification/checks/quantities.hpp"

#include <cmath>

#include "tests/catch.hpp"

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
