#include <chrono>
#include <thread>

#include "tests/catch.hpp"
#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

namespace {

const std::string study = study_text("Foreign", "Theirs is second order", couette_scene() + R"([ladder]
axis = "space"
cells = [8, 16, 32]
theoretical = 2
[[check]]
kind = "order"
lower = 1.8
upper = 2.2
reason = "theory; coarse meshes"
[[check]]
kind = "error"
upper = 1e-2
reason = "a bound"
[[figure]]
kind = "profiles"
title = "Theirs"
)");

std::string solver(const std::string& command) {
  return study + "[solver]\nname = \"theirs\"\ntimeout = 5\ncommand = " + command + "\n";
}

const std::string honest =
    "[\"{mpm-verify}\", \"solve\", \"{scene}\", \"--out\", \"{out}\", \"--no-figures\"]";

/// As honest, with a stream editor over the profile: a planted fault.
std::string edited(const std::string& script) {
  return "[\"sh\", \"-c\", \"{mpm-verify} solve {scene} --out {out} --no-figures > /dev/null && " + script +
         "\"]";
}

}  // namespace

TEST_CASE("a solver that did nothing is not judged by what an earlier one left") {
  const ScratchDirectory scratch;
  const std::string out = (scratch / "out").string();
  REQUIRE(run_program("run " + scratch.write("s.toml", solver(honest)) + " --out " + out).code == 0);
  const Ended ended = run_program("run " + scratch.write("s.toml", solver("\"true\"")) + " --out " + out);
  INFO(ended.output);
  CHECK(ended.code == 3);
  CHECK_THAT(ended.output, contains("it left no profile.csv"));
}

TEST_CASE("planted faults of a foreign solver turn its study red, each with a name") {
  const ScratchDirectory scratch;
  const auto run = [&](const std::string& command) {
    return run_program("run " + scratch.write("s.toml", solver(command)) + " --out " +
                       (scratch / "out").string());
  };
  struct Fault {
    const char* script;
    int code;
    const char* said;
  };
  // awk -F, 'condition' keeps the header (NR == 1) and the rows that fulfil it.
  const Fault faults[] = {
      {"awk -F, 'NR == 1 || $1 == 0.1' {out}/profile.csv > {out}/p && mv {out}/p {out}/profile.csv", 3,
       "found t = 0.1; expected 0.1, 0.2"},
      {"awk -F, 'NR == 1 || $4 == 0' {out}/profile.csv > {out}/p && mv {out}/p {out}/profile.csv", 3,
       "expected at least 8"},
      {"sed -i '5s/,[^,]*,[^,]*$/,nan,0/' {out}/profile.csv", 3, "is not finite"},
      {"head -n 1 {out}/profile.csv > {out}/p && mv {out}/p {out}/profile.csv", 3, "found no rows"},
      {"awk -F, 'NR == 1 {print; next} {OFS = FS; $5 = 1.05 * $5; print}' {out}/profile.csv > {out}/p && mv "
       "{out}/p "
       "{out}/profile.csv",
       1, "FAIL"},
      {"sleep 30", 3, "no end within 5 s"},
      {"echo the reason is here && exit 7", 3, "exit code 7"},
      {"echo the reason is here && exit 7", 3, "its log ends: the reason is here"},
  };
  for (const Fault& fault : faults) {
    const Ended ended = run(edited(fault.script));
    INFO(fault.script << "\n" << ended.output);
    CHECK(ended.code == fault.code);
    CHECK_THAT(ended.output, contains(fault.said));
  }
}

TEST_CASE("a time ladder of somebody's rows does not depend on their order") {
  const ScratchDirectory scratch;
  const std::string ladder = replaced(study, "axis = \"space\"\ncells = [8, 16, 32]\ntheoretical = 2",
                                      "axis = \"time\"\ndt = [4e-3, 2e-3, 1e-3]\ntheoretical = 1");
  const std::string time = replaced(ladder, "lower = 1.8\nupper = 2.2", "lower = 0.9\nupper = 1.1");
  const std::string out = (scratch / "out").string();
  const auto run = [&](const std::string& command) {
    const Ended ended = run_program(
        "run " + scratch.write("s.toml", time + "[solver]\ncommand = " + command + "\n") + " --out " + out);
    INFO(ended.output);
    CHECK(ended.code == 0);
    return content_of(scratch / "out" / "orders.csv");
  };
  const std::string in_order = run(honest);
  // The rows of every other level upside down.
  const std::string shuffled =
      run(edited("if expr {dt} '>' 0.0015 '&' {dt} '<' 0.003; then (head -n 1 {out}/profile.csv; tail -n +2 "
                 "{out}/profile.csv | "
                 "sort -r) > {out}/p && mv {out}/p {out}/profile.csv; fi"));
  CHECK(in_order == shuffled);
}

TEST_CASE("locations are those that the solver delivers, in every run, unless the study says which") {
  const ScratchDirectory scratch;
  const std::string out = (scratch / "out").string();
  const auto run = [&](const std::string& command) {
    return run_program("run " + scratch.write("s.toml", solver(command)) + " --out " + out);
  };
  const Ended both = run(honest);
  INFO(both.output);
  CHECK(both.code == 0);
  const std::string grid_alone =
      "grep -v particles {out}/profile.csv > {out}/p && mv {out}/p {out}/profile.csv";
  const Ended grid = run(edited(grid_alone));
  INFO(grid.output);
  CHECK(grid.code == 0);
  CHECK(count(content_of(scratch / "out" / "checks.csv"), ", particles") == 0);
  CHECK(count(content_of(scratch / "out" / "checks.csv"), ", grid") > 0);

  // One level without its particles is a lack, not a study of the grid.
  const Ended one = run(edited("if [ {cells} = 16 ]; then " + grid_alone + "; fi"));
  INFO(one.output);
  CHECK(one.code == 1);
  CHECK_THAT(content_of(scratch / "out" / "checks.csv"), contains("nan"));

  const Ended none = run(edited(
      "sed s/grid/mesh/ {out}/profile.csv | grep -v particles > {out}/p && mv {out}/p {out}/profile.csv"));
  INFO(none.output);
  CHECK(none.code == 3);
  CHECK_THAT(none.output, contains("found location 'mesh'; expected grid, particles"));
}
