#include <cmath>
#include <numbers>

#include "tests/study_text.hpp"
#include "tests/unit/verification/read_text.hpp"
#include "verification/runs/measures.hpp"

using namespace verification;

namespace {

auto about(double value, double relative = 1e-9) {
  return Catch::Matchers::WithinRel(value, relative);
}

/// A ladder of four grids whose probe is off by 0.01 h^p of the plate's velocity (h in cells of the coarsest)
/// and whose one sample has that error too.
StudyData measured(const Study& study, double p) {
  StudyData data;
  data.study = &study;
  for (const PlannedRun& planned : study.runs) {
    const double error = 0.01 * std::pow(8.0 / planned.scene.discretisation.cells, p);
    RunData run;
    run.plan = &planned;
    run.record.run = planned.run;
    run.record.status = "completed";
    run.profile = {{0.1, "grid", 0, 5e-4, 1e-4 * (0.5 + error), 0, 0.5e-4, 0},
                   {0.2, "grid", 0, 5e-4, 1e-4 * (0.5 + error), 0, 0.5e-4, 0}};
    run.probe = {1e-4 * (0.5 + error), 1e-4 * (0.5 + error)};
    run.errors = measure_errors(run);
    data.runs.push_back(run);
  }
  measure_orders(data);
  return data;
}

const reports::OrderRecord& l2_on_grid(const StudyData& data) {
  for (const reports::OrderRecord& order : data.orders)
    if (order.location == "grid" && order.norm == "l2" && order.t == 0.2) return order;
  FAIL("no such order");
  return data.orders.front();
}

Study ladder() {
  return read_study_text(
      study_text("T", "C",
                 couette_scene() + "[ladder]\naxis = \"space\"\ncells = [8, 16, 32, 64]\ntheoretical = 2\n"
                                   "[[check]]\nkind = \"error\"\nupper = 1\nreason = \"any\"\n"));
}

}  // namespace

TEST_CASE("GCI, its factor, U95 and the interval of a ladder are those of its made error", "[measures]") {
  const Study study = ladder();
  const StudyData data = measured(study, 2);
  const reports::OrderRecord& order = l2_on_grid(data);
  CHECK_THAT(order.observed, about(2));
  CHECK_THAT(order.ci_lower, about(2, 1e-6));
  CHECK_THAT(order.ci_upper, about(2, 1e-6));
  // Of the probe: 1.25 times the finest grid's error, which Richardson finds exactly.
  const double finest = 0.01 / 64;
  CHECK_THAT(order.gci_safety_factor, about(1.25));
  CHECK_THAT(order.gci, about(1.25 * finest, 1e-6));
  CHECK_THAT(order.uncertainty, about(1.25 * finest, 1e-3));
  CHECK(order.levels_used == 4);
}

TEST_CASE("a ladder of another order than the scheme's has the cautious factor", "[measures]") {
  const Study study = ladder();
  const StudyData data = measured(study, 1);
  const reports::OrderRecord& order = l2_on_grid(data);
  CHECK_THAT(order.observed, about(1));
  CHECK_THAT(order.gci_safety_factor, about(3));
  CHECK(order.gci > 0.01 / 8);  // no less than the error that is there
  CHECK(order.uncertainty > 0.01 / 8);
}

TEST_CASE("of the particles nothing is claimed where none were sampled", "[measures]") {
  const Study study = ladder();
  const StudyData data = measured(study, 2);
  for (const reports::OrderRecord& order : data.orders)
    if (order.location == "particles") {
      CHECK(std::isnan(order.observed));
      CHECK(std::isnan(order.gci));
      CHECK(order.classification == "invalid");
    }
}
