#include <algorithm>
#include <map>

#include "tests/catch.hpp"
#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

namespace {

const std::string scene = couette_scene();

const std::string study = study_text("Tiny", "A tiny study", scene + R"([ladder]
axis = "space"
cells = [8, 16, 32]
theoretical = 2
[[variant]]
name = "usf"
[[variant]]
name = "musl"
scheme.stepping = "musl"
[[check]]
kind = "order"
lower = 1.8
upper = 2.2
reason = "theory; coarse meshes"
[[figure]]
kind = "convergence"
title = "Tiny, and second order"
[[figure]]
kind = "profiles"
variants = ["usf"]
title = "Tiny profiles"
)");

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// Every file below a directory, by relative name.
std::map<std::string, std::string> tree(const std::filesystem::path& root) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
    if (entry.is_regular_file())
      files[std::filesystem::relative(entry.path(), root).string()] = content_of(entry.path());
  return files;
}

}  // namespace

TEST_CASE("a suite writes its tables, the same bytes whatever the jobs, and a report rebuilds from them") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("tiny.toml", study);
  const auto one = scratch.path() / "one", two = scratch.path() / "two";
  const Ended ended = run_program("run " + file + " --no-cache --jobs 1 --out " + one.string());
  INFO(ended.output);
  REQUIRE(ended.code == 0);
  REQUIRE(run_program("run " + file + " --no-cache --jobs 2 --out " + two.string()).code == 0);

  CHECK(first_line(content_of(one / "runs.csv")) ==
        "run,study,scene,fluid,method,basis,transfer,stepping,reset,cells,particles,dt,steps,status");
  CHECK(first_line(content_of(one / "errors.csv")) == "run,t,location,l1,l2,linf,scale,exact_max");
  CHECK(first_line(content_of(one / "checks.csv")) == "study,check,observed,lower,upper,unit,verdict,reason");
  CHECK(first_line(content_of(one / "timing.csv")) ==
        "run,wall_s,particle_steps_per_s,repetitions,spread,source,clock");

  const auto files_one = tree(one), files_two = tree(two);
  REQUIRE(files_one.size() == files_two.size());
  for (const auto& [name, content] : files_one) {
    INFO(name);
    if (name.ends_with(".csv") && name != "timing.csv") CHECK(files_two.at(name) == content);
  }

  std::filesystem::remove_all(one / "figures");
  std::filesystem::remove(one / "report.html");
  std::filesystem::remove(one / "report.md");
  REQUIRE(run_program("report " + one.string()).code == 0);
  const auto rebuilt = tree(one);
  REQUIRE(rebuilt.size() == files_one.size());
  for (const auto& [name, content] : files_one) {
    INFO(name);
    CHECK(rebuilt.at(name) == content);
  }
}

TEST_CASE("a failed check is exit code 1 and printed last") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("tiny.toml", replaced(study, "lower = 1.8", "lower = 2.15"));
  const Ended ended = run_program("run " + file + " --out " + (scratch.path() / "out").string());
  CHECK(ended.code == 1);
  CHECK(ended.output.rfind("\nFAIL ") > ended.output.rfind("\npass "));
  CHECK_THAT(content_of(scratch.path() / "out" / "report.md"), contains("FAIL"));
}

TEST_CASE("a run that blows up is recorded and fails its study") {
  const ScratchDirectory scratch;
  // nu dt/h^2 = 13 on the coarsest mesh: far beyond any explicit limit.
  const std::string file = scratch.write("tiny.toml", replaced(study, "dt = 2e-3", "dt = 0.2"));
  const auto out = scratch.path() / "out";
  const std::string long_run = replaced(content_of(file), "outputs = [0.1, 0.2]", "outputs = [100, 200]");
  const Ended ended = run_program("run " + scratch.write("tiny.toml", long_run) + " --out " + out.string());
  INFO(ended.output);
  CHECK(ended.code == 1);
  CHECK_THAT(content_of(out / "runs.csv"), contains("diverged at t = "));
  CHECK_THAT(content_of(out / "checks.csv"), contains("runs that did not complete"));
  CHECK(std::filesystem::exists(out / "report.html"));
}

TEST_CASE("without gnuplot everything but the figures is there, with one warning") {
  const ScratchDirectory scratch;
  const auto out = scratch.path() / "out";
  const Ended ended = run_program("run " + scratch.write("tiny.toml", study) + " --out " + out.string(),
                                  "MPM_GNUPLOT=/nowhere/gnuplot");
  INFO(ended.output);
  CHECK(ended.code == 0);
  const std::string warning = "warning: ";
  const auto at = ended.output.find(warning);
  REQUIRE(at != std::string::npos);
  CHECK(ended.output.find(warning, at + 1) == std::string::npos);
  for (const char* file :
       {"runs.csv", "errors.csv", "orders.csv", "checks.csv", "report.md", "report.html", "junit.xml"})
    CHECK(std::filesystem::exists(out / file));
}

TEST_CASE("a full disk is one message and exit code 2; what was written stays") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("tiny.toml", study);
  const auto out = scratch.path() / "out";
  // Files above 4 KiB cannot be written: the small scene files can, the profiles cannot.
  const Ended ended =
      run_program("run " + file + " --no-cache --out " + out.string(), "trap '' XFSZ; ulimit -f 8;");
  INFO(ended.output);
  CHECK(ended.code == 2);
  CHECK(std::count(ended.output.begin(), ended.output.end(), '\n') == 1);
  CHECK_THAT(ended.output, contains("cannot write"));
  CHECK_FALSE(std::filesystem::is_empty(out / "scenes"));
  CHECK(std::filesystem::is_empty(out / "profiles"));
}

TEST_CASE("another solver is judged by what it writes") {
  const ScratchDirectory scratch;
  const std::string ours = scratch.write("ours.toml", study);
  // The stand-in for somebody else's solver is ours, started as a program of its own.
  const std::string command =
      "[solver]\ncommand = \"" + std::string(MPM_VERIFY_PROGRAM) + " solve {scene} --out {out}\"\n";
  const std::string theirs = scratch.write("theirs.toml", study + command);
  const auto out_ours = scratch.path() / "ours", out_theirs = scratch.path() / "theirs";
  REQUIRE(run_program("run " + ours + " --out " + out_ours.string()).code == 0);
  const Ended ended = run_program("run " + theirs + " --out " + out_theirs.string());
  INFO(ended.output);
  REQUIRE(ended.code == 0);
  std::string errors = content_of(out_theirs / "errors.csv");
  for (std::size_t at; (at = errors.find("theirs.")) != std::string::npos;) errors.replace(at, 7, "ours.");
  CHECK(errors == content_of(out_ours / "errors.csv"));

  const std::string broken = scratch.write("broken.toml", study + "[solver]\ncommand = \"false\"\n");
  CHECK(run_program("run " + broken + " --out " + (scratch.path() / "broken").string()).code == 3);
}

TEST_CASE("one scene: simulated with its errors, or its reference alone") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("plate.toml", scene);
  const auto solved = scratch.path() / "solved", exact = scratch.path() / "exact";
  const Ended ended = run_program("solve " + file + " --out " + solved.string());
  CHECK(ended.code == 0);
  CHECK_THAT(ended.output, contains("errors relative to 0.0001 m/s"));
  for (const char* name : {"profiles/plate.csv", "profiles/plate.history.csv", "errors.csv", "profile.csv"})
    CHECK(std::filesystem::exists(solved / name));
  REQUIRE(run_program("reference " + file + " --out " + exact.string()).code == 0);
  CHECK_THAT(content_of(exact / "profiles" / "plate.csv"), contains("0.2,exact,"));
  CHECK(run_program("list").code == 0);
}
