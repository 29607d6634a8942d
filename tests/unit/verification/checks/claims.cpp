#include "tests/study_text.hpp"
#include "tests/unit/verification/read_text.hpp"
#include "verification/checks/check_reader.hpp"

using namespace verification;

namespace {

/// Whether a claim stands that rests on two checks of an error of 0.1 with these bounds.
bool stands(double first, double second) {
  const auto check = [](double upper) {
    return "[[check]]\nkind = \"error\"\nlocations = [\"grid\"]\ntimes = [0.1]\nupper = " +
           std::to_string(upper) + "\nreason = \"r\"\nevidence_for = \"c\"\n";
  };
  const Study study = read_study_text(study_text(
      "T", "C",
      couette_scene() + check(first) + check(second) +
          "[[statement]]\nid = \"c\"\nsource = \"Fig. 1\"\nstatement = \"s\"\nverdict = \"confirmed\"\n"));
  StudyData data;
  data.study = &study;
  RunData run;
  run.plan = &study.runs.front();
  run.record.run = run.plan->run;
  run.record.status = "completed";
  run.errors = {{run.record.run, 0.1, "grid", 0.1, 0.1, 0.1}};
  data.runs = {run};
  evaluate_checks(data);
  REQUIRE(data.claims.size() == 1);
  return data.claims.front().stands;
}

}  // namespace

TEST_CASE("a claim stands when all that it rests on holds, whichever comes last") {
  CHECK(stands(0.2, 0.3));
  CHECK_FALSE(stands(0.2, 0.05));
  CHECK_FALSE(stands(0.05, 0.2));
  CHECK_FALSE(stands(0.05, 0.05));
}
