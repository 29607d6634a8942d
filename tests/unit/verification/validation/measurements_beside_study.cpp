#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"
#include "tests/study_text.hpp"
#include "verification/config/config_error.hpp"
#include "verification/reading/study_reader.hpp"

using namespace verification;

namespace {

// The gap is 1 mm, the outputs are 0.1 and 0.2 s; the rows stand in lines 5 and 6.
const std::string measured = R"(# source: made up for this test
# obtained: written down
# licence: facts
quantity,t,x,y,value,uncertainty,unit,note
u,0.1,,0.5e-3,5e-5,1e-6,m/s,
u,0.2,,0.5e-3,5e-5,1e-6,m/s,
)";

const std::string study = study_text("T", "C", couette_scene() + R"([ladder]
axis = "space"
cells = [8, 16, 24]
theoretical = 2
[validation]
data = ["measured.csv"]
[[validation.quantity]]
name = "u"
largest_error = 1e-5
reason = "a tenth of the plate's velocity"
)",
                                     "suite = \"quick\"\nexpected_checks = 3\n");

std::string refusal(const std::string& table, const std::string& text = study) {
  const ScratchDirectory scratch;
  scratch.write("measured.csv", table);
  try {
    read_study(scratch.write("study.toml", text));
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal(const std::string& from, const std::string& to, const std::string& text) {
  return refusal(replaced(measured, from, to), text);
}

}  // namespace

TEST_CASE("Measurements beside a study: what it can deliver is accepted", "[validation]") {
  CHECK(refusal(measured) == "accepted");
  // The walls themselves belong to the run.
  CHECK(refusal("0.1,,0.5e-3", "0.1,,0", study) == "accepted");
  CHECK(refusal("0.1,,0.5e-3", "0.1,,1e-3", study) == "accepted");
}

TEST_CASE("Measurements beside a study: places and times outside of its runs are refused before they run",
          "[validation]") {
  const std::string above = refusal("0.1,,0.5e-3", "0.1,,1.01e-3", study);
  CHECK_THAT(above, contains("measured.csv:5: y = 0.00101 m lies outside of run") &&
                        contains("(0 to 0.001 m)") && contains("correct the place or its scale"));
  CHECK_THAT(refusal("0.2,,0.5e-3", "0.2,,-1e-6", study), contains("measured.csv:6: y = -1e-06 m"));
  CHECK_THAT(refusal("0.2,,0.5e-3", "0.2,1,0.5e-3", study),
             contains("measured.csv:6: x = 1 m lies outside of run"));
  // Millimetres in a column of metres.
  CHECK_THAT(refusal("0.1,,0.5e-3", "0.1,,0.5", study), contains("measured.csv:5: y = 0.5 m"));

  const std::string later = refusal("u,0.2", "u,0.3", study);
  CHECK_THAT(later, contains("measured.csv:6: t = 0.3 s is no output of run") &&
                        contains("the last is 0.2 s") && contains("add it to time.outputs"));
  CHECK_THAT(refusal("u,0.1", "u,0.15", study), contains("measured.csv:5: t = 0.15 s is no output"));
}

TEST_CASE("Measurements beside a study: scaled places are judged in metres", "[validation]") {
  const std::string scaled = replaced(study, "data = ", "velocity = 1e-4\nlength = 1e-3\ndata = ");
  std::string table =
      replaced(measured, "# licence: facts\n", "# licence: facts\n# scales: velocity length\n");
  // t V/L = 0.01 and 0.02.
  table = replaced(table, "u,0.1,,0.5e-3,5e-5,1e-6,m/s", "u,0.01,,0.5,0.5,0.01,1");
  table = replaced(table, "u,0.2,,0.5e-3,5e-5,1e-6,m/s", "u,0.02,,0.5,0.5,0.01,1");
  CHECK(refusal(table, scaled) == "accepted");
  CHECK_THAT(refusal(replaced(table, "0.01,,0.5,", "0.01,,1.5,"), scaled),
             contains("measured.csv:6: y = 0.0015 m lies outside of run"));
  CHECK_THAT(refusal(replaced(table, "u,0.02", "u,0.03"), scaled),
             contains("measured.csv:7: t = 0.3 s is no output"));
}
