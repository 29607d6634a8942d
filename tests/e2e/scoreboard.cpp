#include "tests/catch.hpp"
#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

namespace {

// nu dt/h^2 = 3.2: beyond every explicit limit; backward Euler does not mind.
const std::string board = study_text("Large steps", "Explicit steps diverge, implicit ones do not",
                                     couette_scene("cells = 8", "dt = 0.05\noutputs = [5.0]") + R"([matrix]
basis = ["linear"]
transfer = ["flip", "apic"]
stepping = ["usf", "implicit-euler"]
[scoreboard]
case = "large steps"
degraded_above = 0.1
reason = "errors are below 1e-3, or above 1e3"
in_quick = ["linear_flip_usf"]
[[expect]]
outcome = "diverged"
reason = "nu dt/h^2 = 3.2 against 3/2"
[[expect]]
stepping = ["implicit-euler"]
outcome = "survived"
reason = "no limit"
)",
                                     "suite = \"deep\"\n");

}  // namespace

TEST_CASE("a scoreboard: declared divergence is no failure, and the report shows every scheme") {
  const ScratchDirectory scratch;
  const auto out = scratch.path() / "out";
  const Ended ended = run_program("run " + scratch.write("large.toml", board) + " --out " + out.string());
  INFO(ended.output);
  CHECK(ended.code == 0);
  CHECK_THAT(ended.output, contains("PASS: 4 of 4 checks hold"));
  CHECK_THAT(ended.output, contains("large steps: schemes with the expected outcome"));
  const std::string scores = content_of(out / "scoreboard.csv");
  CHECK_THAT(scores, contains("large,large steps,linear_flip_usf,linear,flip,usf,diverged,diverged,pass,"));
  CHECK_THAT(scores,
             contains("linear_apic_implicit-euler,linear,apic,implicit-euler,survived,survived,pass,nan,"));
  CHECK_THAT(content_of(out / "runs.csv"), contains("diverged at t = "));
  CHECK_THAT(content_of(out / "report.md"), contains("| large steps | 4 | 2 | 0 | 2 | 0 |"));
  CHECK(content_of(out / "report.md").find("did not complete") == std::string::npos);
  CHECK_THAT(content_of(out / "report.html"), contains("Stability scoreboard"));
  CHECK(content_of(out / "report.html").find("unexpected\"") == std::string::npos);

  const Ended quick = run_program("run " + scratch.write("large.toml", board) + " --suite quick --out " +
                                  (scratch.path() / "quick").string());
  CHECK(quick.code == 0);
  CHECK_THAT(quick.output, contains("PASS: 1 of 1 checks hold"));
}

TEST_CASE("a scoreboard goes red for an expected divergence that survives and an unexpected one") {
  const ScratchDirectory scratch;
  const auto out = scratch.path() / "out";
  const std::string stable = replaced(board, "dt = 0.05", "dt = 0.005");
  const Ended survived = run_program("run " + scratch.write("large.toml", stable) + " --out " + out.string());
  INFO(survived.output);
  CHECK(survived.code == 1);
  CHECK_THAT(survived.output, contains("linear_flip_usf: diverged"));
  CHECK_THAT(survived.output, contains("but it survived"));
  CHECK_THAT(content_of(out / "report.html"), contains("survived unexpected"));

  const std::string hopeful = replaced(board, "stepping = [\"implicit-euler\"]\n", "");
  const Ended diverged =
      run_program("run " + scratch.write("large.toml", hopeful) + " --out " + out.string());
  CHECK(diverged.code == 1);
  CHECK_THAT(diverged.output, contains("linear_apic_usf: survived"));
  CHECK_THAT(content_of(out / "report.md"), contains("did not complete"));
  CHECK_THAT(content_of(out / "report.md"), contains("| large steps | 4 | 2 | 0 | 2 | **2** |"));
}
