#include <csignal>

#include "tests/catch.hpp"
#include "tests/e2e/program.hpp"
#include "tests/e2e/stopped.hpp"
#include "tests/study_text.hpp"

// A suite in parts: plan, run --shard, collect, judge.
namespace {

/// Runs of a tenth of a second or so, so that a shard can be killed among them.
const std::string slow =
    study_text("Slow", "Long enough to be stopped",
               couette_scene("cells = 16\ncells_along = 4", "dt = 2e-5\noutputs = [0.1, 0.2]") + R"([ladder]
axis = "time"
dt = [2e-5, 1e-5, 5e-6]
theoretical = 1
[[variant]]
name = "a"
[[variant]]
name = "b"
scheme.stepping = "musl"
[[variant]]
name = "c"
scheme.stepping = "leapfrog"
[[variant]]
name = "d"
scheme.stepping = "usl"
[[check]]
kind = "error"
locations = ["grid"]
level = "all"
upper = 1e-2
reason = "O(h^2) on 16 cells, times 3"
[[figure]]
kind = "history"
variants = ["a"]
title = "Slow"
)");

/// Somebody else's solver, of which it is said what decides its results; one of its runs fails.
const std::string theirs =
    study_text("Theirs", "A steady profile", couette_scene("cells = 8", "outputs = [10, 20]") + R"([solver]
name = "line"
version = ["echo", "7"]
locations = ["grid"]
command = ["sh", "-c", "test {run} = theirs.bad && exit 9; awk -v n={cells} 'BEGIN { print \"t,location,x,y,u\"; for (k = 1; k <= 2; ++k) for (j = 0; j <= n; ++j) printf \"%d,grid,0,%.17g,%.17g\\n\", 10 * k, 1e-3 * j / n, 1e-4 * j / n }' > {out}/profile.csv"]
[[variant]]
name = "good"
[[variant]]
name = "bad"
[[check]]
kind = "error"
variants = ["good"]
upper = 1e-9
reason = "written down as it is"
)");

constexpr int shards = 7;

}  // namespace

TEST_CASE("seven shards, two of them killed and gone on with, are one run, byte for byte") {
  const ScratchDirectory scratch;
  const std::string files = scratch.write("slow.toml", slow) + " " + scratch.write("theirs.toml", theirs) +
                            " stability-shear couette-time";
  const std::string environment = "MPM_GNUPLOT=none MPM_CACHE=" + (scratch / "cache").string();
  const auto whole = scratch / "whole", merged = scratch / "merged";
  const Ended at_once = run_program("run " + files + " --no-cache --out " + whole.string(), environment);
  INFO(at_once.output);
  REQUIRE(at_once.code == 3);  // one foreign run fails, and that is a result as well

  const auto shard = [&](int k) {
    return "run " + files + " --jobs 1 --shard " + std::to_string(k) + "/" + std::to_string(shards) +
           " --out " + (scratch / "shards" / std::to_string(k)).string();
  };
  std::filesystem::create_directories(scratch / "shards");
  int failing = 0;
  for (int k = 1; k <= shards; ++k) {
    if (k == 2 || k == 5) {
      // Each has a run or two of the slow study, and others that are quicker.
      REQUIRE(stop_after(1, SIGKILL, shard(k), scratch / "shards" / std::to_string(k) / "cache") ==
              128 + SIGKILL);
      CHECK_THAT(content_of(scratch / "shards" / std::to_string(k) / "shard.json"),
                 contains("\"complete\": false"));
    } else {
      const Ended ended = run_program(shard(k), environment);
      INFO(ended.output);
      CHECK((ended.code == 0 || ended.code == 3));
      failing += ended.code == 3;
    }
  }
  const std::string collect = "collect " + (scratch / "shards").string() + " --out " + merged.string();
  const Ended early = run_program(collect, environment);
  CHECK(early.code == 2);
  CHECK_THAT(early.output, contains("runs are in none of the shards: "));
  CHECK_THAT(early.output, contains("2/7, 5/7"));
  CHECK_FALSE(std::filesystem::exists(merged / "checks.csv"));

  for (const int k : {2, 5}) {
    const int code = run_program(shard(k), environment).code;
    CHECK((code == 0 || code == 3));
    failing += code == 3;
  }
  CHECK(failing == 1);
  const Ended collected = run_program(collect, environment);
  INFO(collected.output);
  CHECK(collected.code == 3);
  CHECK_THAT(collected.output, contains("theirs.bad"));
  auto expected = tables(whole), found = tables(merged);
  // How long the failed run took stands in its status.
  const auto without_seconds = [](std::string text) {
    for (std::size_t at = text.find(" after "); at != text.npos; at = text.find(" after ", at + 1))
      text.erase(at, text.find(" s", at) - at);
    return text;
  };
  REQUIRE(expected.size() == found.size());
  for (const auto& [name, text] : expected) {
    INFO(name);
    CHECK(without_seconds(found[name]) == without_seconds(text));
  }

  SECTION("a run that is nowhere is named, and not simulated") {
    std::filesystem::remove_all(scratch / "shards" / "4");
    const Ended missing = run_program(collect, environment);
    CHECK(missing.code == 2);
    CHECK_THAT(missing.output, contains("4/7"));
  }
  SECTION("a shard of another program, or of another suite, is none of ours") {
    const auto file = scratch / "shards" / "3" / "shard.json";
    const std::string text = content_of(file);
    const std::size_t at = text.find("\"program\": \"") + 12;
    scratch.write("shards/3/shard.json", std::string(text).replace(at, 4, "0000"));
    CHECK_THAT(run_program(collect, environment).output, contains("made by another program"));
    scratch.write("shards/3/shard.json", replaced(text, "\"of\": 7", "\"of\": 8"));
    CHECK_THAT(run_program(collect, environment).output, contains("part of another suite"));
  }
}

TEST_CASE("a plan says which part a run belongs to, the same on every machine") {
  const ScratchDirectory scratch;
  const auto plan = [&](const std::string& name, const std::string& more) {
    return run_program("plan --suite quick --out " + (scratch / name).string() + more);
  };
  REQUIRE(plan("a", " --shards 5").code == 0);
  REQUIRE(plan("b", " --shards 5").code == 0);
  const std::string manifest = content_of(scratch / "a/manifest.json");
  CHECK(manifest == content_of(scratch / "b/manifest.json"));
  for (int k = 1; k <= 5; ++k) CHECK(count(manifest, "\"shard\": " + std::to_string(k) + "\n") > 0);
  // About a minute a shard: the quick suite is one.
  CHECK_THAT(plan("c", " --shards auto").output, contains("shard 1/1: "));
  CHECK_THAT(plan("d", " --shards 0").output, contains("--shards '0'"));
  CHECK_THAT(run_program("run --suite quick --shard 6/5 --out " + (scratch / "e").string()).output,
             contains("part K of N"));
}

TEST_CASE("a plan is judged from the files that were put into it") {
  const ScratchDirectory scratch;
  const std::string study = study_text("Anybody", "Second order", couette_scene() + R"([ladder]
axis = "space"
cells = [8, 16, 32]
theoretical = 2
[[check]]
kind = "order"
lower = 1.8
upper = 2.2
reason = "theory; coarse meshes"
)");
  const std::string file = scratch.write("s.toml", study), dir = (scratch / "plan").string();
  REQUIRE(run_program("plan " + file + " --out " + dir).code == 0);
  const std::string judge = "judge " + dir, environment = "MPM_GNUPLOT=none";
  const Ended nothing = run_program(judge, environment);
  CHECK(nothing.code == 3);
  CHECK_THAT(nothing.output, contains("put profile.csv there"));
  // The scenes are what is solved, by whatever solves them: here, by ourselves.
  for (const char* run : {"s.n8", "s.n16", "s.n32"})
    REQUIRE(
        run_program("solve " + dir + "/scenes/" + run + ".toml --no-figures --out " + dir + "/results/" + run)
            .code == 0);
  scratch.write("plan/results/s.n8/run.json", R"({"name": "ours", "version": "2", "steps": 7})");
  const Ended judged = run_program(judge, environment);
  INFO(judged.output);
  CHECK(judged.code == 0);
  CHECK_THAT(content_of(scratch / "plan/verdict/runs.csv"), contains("newtonian,ours 2,"));
  CHECK_THAT(judged.output, contains("space order, particles"));

  // A profile of the grid alone is judged by what it holds.
  for (const char* run : {"s.n8", "s.n16", "s.n32"}) {
    const std::string profile = content_of(scratch / "plan/results" / run / "profile.csv");
    std::string grid;
    for (std::size_t at = 0; at < profile.size(); at = profile.find('\n', at) + 1) {
      const std::string line = profile.substr(at, profile.find('\n', at) + 1 - at);
      if (line.find(",particles,") == line.npos) grid += line;
    }
    scratch.write("plan/results/" + std::string(run) + "/profile.csv", grid);
  }
  const Ended grid = run_program(judge, environment);
  INFO(grid.output);
  CHECK(grid.code == 0);
  CHECK(grid.output.find("order, particles") == std::string::npos);

  scratch.write("s.toml", replaced(study, "height = 1e-3", "height = 2e-3"));
  CHECK_THAT(run_program(judge, environment).output, contains("is not what it was when this was planned"));
}

TEST_CASE("a job array is written down before anything is submitted") {
  const ScratchDirectory scratch;
  const Ended ended =
      run_program("submit --engine slurm --suite quick --shards 3 --partition long --time 10 --out " +
                  (scratch / "out").string() + " --dry-run");
  INFO(ended.output);
  CHECK(ended.code == 0);
  for (const char* part : {"--array=1-3", "--partition=long", "--time=10", "--dependency=afterok:",
                           "--suite quick", "--shard \"$SLURM_ARRAY_TASK_ID/3\"", "collect "})
    CHECK_THAT(ended.output, contains(part));
  CHECK(run_program("submit --engine pbs --out x").code == 2);
}
