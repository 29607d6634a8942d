#include <cmath>
#include <stdexcept>

#include "tests/catch.hpp"
#include "verification/checks/shift_check.hpp"

using namespace verification;

namespace {

/// A front 1 + t^2 from t = 0 to 3 s.
std::vector<reports::SurfaceRow> record() {
  std::vector<reports::SurfaceRow> rows;
  for (int k = 0; k <= 3000; ++k) {
    const double t = 1e-3 * k;
    rows.push_back({t, 1 + t * t, 0, 0, 0, 0});
  }
  return rows;
}

std::vector<Measurement> measured(double late, double offset) {
  std::vector<Measurement> rows;
  for (const double t : {0.5, 1.0, 1.5, 2.0})
    rows.push_back({"front", t + late, NAN, NAN, 1 + t * t + offset, 0.01, 0, "m", "", 1});
  return rows;
}

}  // namespace

TEST_CASE("best shift: a clock that started late or early is found") {
  const auto surface = record();
  const RunFiles run{nullptr, nullptr, &surface};
  for (const double late : {-0.3, 0.0, 0.4}) {
    const BestShift best = best_shift(run, measured(late, 0));
    CHECK(best.shift == Approx(late).margin(1e-6));
    CHECK(best.deviation < 1e-6);
  }
}

TEST_CASE("best shift: what no shift mends remains") {
  const auto surface = record();
  auto rows = measured(0, 0);
  rows[0].value += 0.1;
  rows[3].value += 0.1;
  const BestShift best = best_shift({nullptr, nullptr, &surface}, rows);
  CHECK(best.deviation > 0.03);
  CHECK(best.deviation < 0.1);
}

TEST_CASE("best shift: without a record, or with one that is too short, there is none") {
  const auto surface = record();
  CHECK_THROWS_AS(best_shift({nullptr, nullptr, nullptr}, measured(0, 0)), std::invalid_argument);
  auto rows = measured(0, 0);
  rows[3].t = 9;
  CHECK_THROWS_AS(best_shift({nullptr, nullptr, &surface}, rows), std::invalid_argument);
}
