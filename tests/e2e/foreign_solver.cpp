#include <cstdlib>

#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

// Somebody else's solver, sound and with planted faults. What must be red is red in every place that says so:
// exit code, console, tables, JUnit, Markdown and page. The solver is a script for awk, which every Debian
// has.
namespace {

const char* const solver_script = R"AWK(
# Central differences for Couette start-up. fault: what is planted.
BEGIN {
  H = 1e-3; V = 1e-4; nu = 1e-6; pi = 3.14159265358979323846
  if (fault == "viscosity") nu *= 1.01
  h = H / n
  file = out "/profile.csv"
  print "t,location,x,y,u,v" > file
  for (j = 0; j < n; ++j) u[j] = 0
  u[n] = V
  dt = 0.25 * h * h / 1e-6
  for (k = 1; k <= 2; ++k) {
    count = int(0.1 / dt + 0.5); r = nu * (0.1 / count) / (h * h)
    for (s = 0; s < count; ++s) {
      for (j = 1; j < n; ++j) w[j] = u[j] + r * (u[j + 1] - 2 * u[j] + u[j - 1])
      for (j = 1; j < n; ++j) u[j] = w[j]
      if (fault == "wall") u[0] = 0.5 * u[1]
    }
    if (fault == "missing-time" && k == 1) continue
    for (j = 0; j <= n; ++j) {
      v = u[j]; y = j * h
      if (fault == "frozen") v = V * y / H
      if (fault == "high-order") {
        v = V * y / H + V * 200 * (h / H)^3 * sin(pi * y / H)
        for (m = 1; m < 40; ++m) v += 2 * V / (m * pi) * (m % 2 ? -1 : 1) * exp(-m * m * pi * pi * k * 0.1) * sin(m * pi * y / H)
      }
      if (fault == "walls-only" && j > 0 && j < n) continue
      if (fault == "nan" && k == 2 && j == 3) v = "nan"
      if (fault == "outside") y += 0.5 * h
      if (fault == "twice" && j == 1) y = 0
      if (fault == "location") printf "%.17g,Grid,0,%.17g,%.17g,0\n", k * 0.1, y, v > file
      else printf "%s,grid,0,%.17g,%s,0\n", fault == "single" ? "0." k "0000000149" : k * 0.1, y, v == "nan" ? v : sprintf("%.17g", v) > file
    }
  }
}
)AWK";

std::string study_with(const std::string& fault, const std::string& more = "") {
  return study_text("Foreign", "A foreign solver is second order",
                    couette_scene() + R"([solver]
name = "fd"
locations = ["grid"]
command = ["awk", "-v", "n={cells}", "-v", "out={out}", "-v", "fault=)" +
                        fault + R"(", "-f", "solver.awk"]
)" + more + R"([ladder]
axis = "space"
cells = [8, 16, 32]
theoretical = 2
[[check]]
kind = "order"
locations = ["grid"]
lower = 1.9
upper = 2.1
reason = "central differences"
[[check]]
kind = "error"
locations = ["grid"]
upper = 4e-4
reason = "2.0e-4 measured; twice that"
)");
}

std::size_t lines_with(const std::string& text, const std::string& part) {
  return count(text, part);
}

/// A code block of a page: the text between ```LANGUAGE and ```.
std::string block_of(const std::string& page, const std::string& language) {
  const std::string mark = "```" + language + "\n";
  const std::size_t begin = page.find(mark);
  REQUIRE(begin != std::string::npos);
  return page.substr(begin + mark.size(), page.find("```", begin + mark.size()) - begin - mark.size());
}

}  // namespace

TEST_CASE("a sound foreign solver passes, in single precision of its times as well") {
  const ScratchDirectory scratch;
  scratch.write("solver.awk", solver_script);
  for (const char* fault : {"none", "single"}) {
    const auto out = scratch.path() / fault;
    const Ended ended = run_program(
        "run " + scratch.write("fd.toml", study_with(fault)) + " --out " + out.string(), "MPM_GNUPLOT=none");
    INFO(ended.output);
    CHECK(ended.code == 0);
    CHECK_THAT(content_of(out / "runs.csv"), contains(",fd"));
    CHECK(lines_with(content_of(out / "junit.xml"), "<failure") == 0);
  }
}

TEST_CASE("negative controls: what must fail does, and every page says so") {
  const ScratchDirectory scratch;
  scratch.write("solver.awk", solver_script);
  struct Control {
    const char* fault;
    int code;
    const char* said;  // by runs.csv or checks.csv
  };
  for (const auto& [fault, code, said] : {Control{"viscosity", 1, "fail"},
                                          {"wall", 1, "fail"},
                                          {"frozen", 1, "fail"},
                                          {"nan", 3, "is not finite"},
                                          {"high-order", 1, "fail"},
                                          {"missing-time", 3, "found t = 0.2; expected 0.1, 0.2"},
                                          {"walls-only", 3, "found 2 points; expected at least 8"},
                                          {"outside", 3, "lies outside the domain"},
                                          {"twice", 3, "is there twice"},
                                          {"location", 3, "found location 'Grid'; expected grid"}}) {
    INFO(fault);
    const auto out = scratch.path() / fault;
    const Ended ended = run_program(
        "run " + scratch.write("fd.toml", study_with(fault)) + " --out " + out.string(), "MPM_GNUPLOT=none");
    INFO(ended.output);
    CHECK(ended.code == code);
    CHECK_THAT(ended.output, contains("FAIL"));
    const std::string checks = content_of(out / "checks.csv");
    CHECK_THAT(checks + content_of(out / "runs.csv"), contains(said));
    const std::size_t failed = lines_with(checks, ",fail,");
    CHECK(failed > 0);
    const std::string junit = content_of(out / "junit.xml");
    CHECK(lines_with(junit, "<failure ") + lines_with(junit, "<error ") == failed);
    // Where nothing could be judged, that is not a failure but an error.
    CHECK(lines_with(junit, "<error ") == lines_with(checks, ",nan,"));
    CHECK_THAT(content_of(out / "report.md"), contains("FAIL"));
    CHECK_THAT(content_of(out / "report.html"), contains("FAIL"));
    if (code == 3) CHECK_THAT(content_of(out / "junit.xml"), contains("profile.csv is not whole"));
  }
}

TEST_CASE("the page on foreign solvers works as it stands; its two faults are red") {
  if (std::system("python3 -c 'import tomllib' > /dev/null 2>&1") != 0) return;  // not on every machine
  const ScratchDirectory scratch;
  const std::string page = content_of(std::string(MPM_DOCS) + "/your-own-solver.md");
  const std::string solver = block_of(page, "python");
  const std::string study = scratch.write("study.toml", block_of(page, "toml"));
  const auto run = [&](const std::string& script) {
    scratch.write("solver.py", script);
    return run_program("run " + study + " --out " + (scratch.path() / "report").string(), "MPM_GNUPLOT=none");
  };
  const Ended sound = run(solver);
  INFO(sound.output);
  CHECK(sound.code == 0);
  CHECK_THAT(content_of(scratch.path() / "report" / "runs.csv"), contains("fd 1.0"));
  CHECK(run(replaced(solver, "[\"kinematic_viscosity\"]", "[\"kinematic_viscosity\"] * 1.01")).code == 1);
  CHECK(run(replaced(solver, "u = [0.0] + [u[j]", "u = [0.5 * u[1]] + [u[j]")).code == 1);
}

TEST_CASE("what a solver says of itself stands in the tables, and a failure that it admits is one") {
  const ScratchDirectory scratch;
  scratch.write("solver.awk", solver_script);
  const std::string text = study_with("none");
  const std::size_t begin = text.find("command = "), end = text.find('\n', begin);
  const auto out = scratch.path() / "out";
  const auto run = [&](const std::string& json) {
    scratch.write("run.sh",
                  "awk -v n=$1 -v out=$2 -f solver.awk && cat > $2/run.json <<'END'\n" + json + "\nEND\n");
    const std::string study =
        text.substr(0, begin) + R"(command = ["sh", "run.sh", "{cells}", "{out}"])" + text.substr(end);
    return run_program("run " + scratch.write("fd.toml", study) + " --out " + out.string(),
                       "MPM_GNUPLOT=none");
  };
  REQUIRE(run(R"({"version": "2.7", "status": "completed", "steps": 123, "cells": 8})").code == 0);
  CHECK_THAT(content_of(out / "runs.csv"), contains("fd 2.7"));
  CHECK_THAT(content_of(out / "runs.csv"), contains(",123,completed"));
  const Ended admitted = run(R"({"status": "failed", "message": "no convergence in step 7"})");
  CHECK(admitted.code == 3);
  CHECK_THAT(admitted.output, contains("no convergence in step 7"));
  CHECK_THAT(content_of(out / "junit.xml"), contains("no convergence in step 7"));
  CHECK(run("{ not json").code == 3);
}
