#include <cmath>

#include "tests/study_text.hpp"
#include "tests/unit/verification/read_text.hpp"
#include "verification/checks/comparison.hpp"
#include "verification/checks/quantities/quantities.hpp"

using namespace verification;

TEST_CASE("nothing is measured of a run that left no records: NaN, and no crash") {
  const std::string plate =
      replaced(couette_scene(), "flow = \"couette\"", "flow = \"oscillating-plate\"\nfrequency = 2");
  for (const std::string& scene : {couette_scene(), plate}) {
    const Study study = read_study_text(
        study_text("T", "C", scene + "[[check]]\nkind = \"error\"\nupper = 1\nreason = \"none\"\n"));
    for (const char* status : {"completed", "failed: no such thing"}) {
      RunData run;
      run.plan = &study.runs.front();
      run.record.run = run.plan->run;
      run.record.status = status;
      CHECK(std::isnan(mass_drift(run)));
      CHECK(std::isnan(momentum_drift(run)));
      for (const std::string& quantity : quantity_names()) {
        INFO(quantity);
        CHECK_FALSE(std::isfinite(evaluate({quantity, 0.1, 0.5}, run)));
      }
    }
  }
}
