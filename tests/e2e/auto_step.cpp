#include <algorithm>
#include <map>

#include "tests/catch.hpp"
#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

// dt = "auto": steps that pilot runs choose.
namespace {

const std::string environment = "MPM_GNUPLOT=none MPM_CACHE=";

const std::string scene_with_auto = couette_scene(
                                        "cells = 6\ncells_along = 1\nparticles_along = 1\n"
                                        "particles_across = 3\nseeding = \"gauss\"",
                                        "dt = \"auto\"\nhistory_samples = 2\noutputs = [0.1, 0.2]") +
                                    "[scheme]\nbasis = \"cubic\"\ntransfer = \"full-mass\"\n"
                                    "stepping = \"implicit-sdirk2\"\n";

const std::string study = study_text("Auto", "Steps by error", scene_with_auto + R"([ladder]
axis = "space"
cells = [6, 9, 12]
theoretical = 4
[[variant]]
name = "sdirk2"
[[variant]]
name = "leapfrog"
scheme.stepping = "leapfrog"
time.cfl_viscous = 0.01 # a limit that is shorter than accuracy asks for
[[variant]]
name = "loose"
time.time_error_fraction = 0.5
[[check]]
kind = "error"
locations = ["grid"]
level = "all"
upper = 1e-3
reason = "a test of the machinery"
)");

/// Every table that must not depend on how it came about.
std::map<std::string, std::string> tables_of(const std::filesystem::path& dir) {
  std::map<std::string, std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(dir))
    if (entry.path().extension() == ".csv" && entry.path().filename() != "timing.csv" &&
        entry.path().filename() != "changes.csv")
      found[entry.path().filename().string()] = content_of(entry.path());
  for (const auto& entry : std::filesystem::directory_iterator(dir / "scenes"))
    found[entry.path().filename().string()] = content_of(entry.path());
  return found;
}

Ended run(const std::string& arguments) {
  const Ended ended = run_program(arguments, environment);
  INFO(ended.output);
  REQUIRE(ended.code == 0);
  return ended;
}

}  // namespace

TEST_CASE("steps that pilots choose are the same for any number of jobs, from the cache, and in shards") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("auto.toml", study);
  const auto out = [&](const std::string& name) { return " --out " + (scratch / name).string(); };
  const Ended one = run("run " + file + " --jobs 1 --no-cache" + out("one"));
  CHECK_THAT(one.output, contains("auto, sdirk2: dt = ") && contains("error in time"));
  CHECK_THAT(one.output, contains("(stability)"));
  const auto expected = tables_of(scratch / "one");
  REQUIRE(expected.contains("time-steps.csv"));
  REQUIRE(expected.contains("pilots.csv"));
  CHECK(count(expected.at("time-steps.csv"), "\nauto.") == 9);
  CHECK(expected.at("auto.sdirk2.n6.toml").find("auto") == std::string::npos);  // numbers by now
  CHECK_THAT(content_of(scratch / "one/report.md"), contains("## Time steps by error"));
  CHECK_THAT(content_of(scratch / "one/report.html"), contains("Time steps by error"));

  run("run " + file + " --jobs 4 --no-cache" + out("four"));
  CHECK(tables_of(scratch / "four") == expected);

  const std::string cached = environment + (scratch / "cache").string();
  REQUIRE(run_program("run " + file + out("filled"), cached).code == 0);
  const Ended again = run_program("run " + file + out("again"), cached);
  CHECK_THAT(again.output, contains("9, of which 9 taken from the cache"));
  CHECK(tables_of(scratch / "again") == expected);

  for (const char* k : {"1", "2"})
    run("run " + file + " --shard " + k + std::string("/2") + out("shards-" + std::string(k)));
  run("collect " + (scratch / "shards-1").string() + " " + (scratch / "shards-2").string() +
      out("collected"));
  CHECK(tables_of(scratch / "collected") == expected);

  run("plan " + file + out("plan"));
  CHECK_THAT(content_of(scratch / "plan/scenes/auto.loose.n12.toml"), contains("dt = 0.0"));
}

TEST_CASE("a scene solves itself with a step of its own choice, or says why not") {
  const ScratchDirectory scratch;
  const std::string out = " --out " + (scratch / "out").string();
  const Ended solved = run("solve " + scratch.write("auto.toml", scene_with_auto) + out + " --no-figures");
  CHECK_THAT(solved.output, contains("auto: dt = ") && contains("pilot runs"));
  CHECK(std::filesystem::exists(scratch / "out/time-steps.csv"));
  const Ended lossy = run_program(
      "solve " + scratch.write("lossy.toml", replaced(scene_with_auto, "\"full-mass\"", "\"pic\"")) + out,
      environment);
  CHECK(lossy.code == 2);
  CHECK_THAT(lossy.output, contains("lossy.toml") && contains("'time.dt'") && contains("give the step in s"));
}

TEST_CASE("a study whose step no pilot can choose is red, and says why") {
  const ScratchDirectory scratch;
  // First order in time beside fourth in space: 64 cells would take millions of steps.
  const std::string text = study_text("None", "C", R"([scene]
flow = "poiseuille"
height = 1e-3
body_acceleration = 8e-3
[fluid]
kinematic_viscosity = 1e-6
pressure = false
[discretisation]
cells = 8
cells_along = 1
seeding = "gauss"
particles_across = 3
[scheme]
basis = "cubic"
transfer = "full-mass"
stepping = "implicit-euler"
[time]
dt = "auto"
history_samples = 2
outputs = [0.05]
[ladder]
axis = "space"
cells = [8, 64]
theoretical = 4
[[check]]
kind = "error"
locations = ["grid"]
level = "all"
upper = 1
reason = "any"
)");
  const Ended ended = run_program(
      "run " + scratch.write("none.toml", text) + " --out " + (scratch / "out").string(), environment);
  INFO(ended.output);
  CHECK(ended.code == 1);
  CHECK_THAT(ended.output, contains("no step was chosen") && contains("take a stepping of higher order"));
  CHECK_THAT(content_of(scratch / "out/checks.csv"), contains("time step by its error"));
  CHECK_THAT(content_of(scratch / "out/junit.xml"), contains("time step by its error"));
}
