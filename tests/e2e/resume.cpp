#include <algorithm>
#include <csignal>

#include "tests/catch.hpp"
#include "tests/e2e/program.hpp"
#include "tests/e2e/stopped.hpp"
#include "tests/study_text.hpp"

namespace {

/// Six runs of a tenth of a second or so each, after a quick one.
const std::string study = study_text(
    "Slow", "Long enough to be stopped",
    couette_scene("cells = 16\ncells_along = 4", "dt = 2e-5\noutputs = [0.1, 0.2]") + R"([[variant]]
name = "a"
[[variant]]
name = "b"
scheme.stepping = "musl"
[[variant]]
name = "c"
scheme.stepping = "leapfrog"
[[variant]]
name = "d"
scheme.transfer = "apic"
[[variant]]
name = "e"
scheme.stepping = "usl"
[[check]]
kind = "error"
locations = ["grid"]
upper = 1e-2
reason = "O(h^2) on 16 cells, times 3"
[[figure]]
kind = "history"
title = "Slow"
)");

}  // namespace

TEST_CASE("the second run of a suite comes from the cache, with the same bytes") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("slow.toml", study);
  const std::string environment = "MPM_CACHE=" + (scratch.path() / "cache").string();
  const auto first = scratch.path() / "first", second = scratch.path() / "second",
             bare = scratch.path() / "bare";
  REQUIRE(run_program("run " + file + " --jobs 2 --no-cache --out " + bare.string(), environment).code == 0);
  CHECK_FALSE(std::filesystem::exists(scratch.path() / "cache" / "runs"));
  Ended ended = run_program("run " + file + " --out " + first.string(), environment);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.output, contains("runs: 5, of which 0 taken from the cache"));
  CHECK(count(content_of(first / "timing.csv"), ",measured,simulation\n") == 5);

  ended = run_program("run " + file + " --jobs 1 --out " + second.string(), environment);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.output, contains("runs: 5, of which 5 taken from the cache"));
  CHECK(count(content_of(second / "timing.csv"), ",cache,simulation\n") == 5);
  CHECK(tables(first) == tables(second));
  CHECK(tables(first) == tables(bare));
  CHECK(content_of(first / "figures" / "slow-history.svg") ==
        content_of(second / "figures" / "slow-history.svg"));

  SECTION("--fresh runs all of it again") {
    ended = run_program("run " + file + " --fresh --out " + second.string(), environment);
    CHECK_THAT(ended.output, contains("of which 0 taken from the cache"));
    CHECK(tables(first) == tables(second));
  }
  SECTION("damaged entries are run again") {
    int damaged = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch.path() / "cache" / "runs"))
      if (entry.path().extension() == ".run" && damaged++ < 2)
        std::filesystem::resize_file(entry.path(), entry.file_size() - 100);
    ended = run_program("run " + file + " --out " + second.string(), environment);
    CHECK_THAT(ended.output, contains("of which 3 taken from the cache"));
    CHECK(tables(first) == tables(second));
  }
  SECTION("a cache that cannot be written is one warning, and no failure") {
    const std::string blocked = "MPM_CACHE=" + scratch.write("occupied", "");
    ended = run_program("run " + file + " --out " + second.string(), blocked);
    CHECK(ended.code == 0);
    CHECK(count(ended.output, "warning: ") == 1);
    CHECK(tables(first) == tables(second));
  }
}

TEST_CASE("a suite that was stopped goes on where it was, with the same bytes") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("slow.toml", study);
  const auto cache = scratch.path() / "cache", out = scratch.path() / "out", whole = scratch.path() / "whole";
  const std::string environment = "MPM_CACHE=" + cache.string();
  const int signal = GENERATE(SIGINT, SIGTERM, SIGKILL);
  INFO("signal " << signal);
  REQUIRE(run_program("run " + file + " --no-cache --out " + whole.string(), environment).code == 0);

  const std::string command = "run " + file + " --jobs 1 --out " + out.string();
  REQUIRE(stop_after(2, signal, command, cache) == 128 + signal);
  CHECK_FALSE(std::filesystem::exists(out / "report.html"));
  if (signal == SIGKILL) {
    CHECK_FALSE(std::filesystem::exists(out / "checks.csv"));
  } else {
    CHECK_THAT(content_of(out / "checks.csv"), contains("runs that ended"));
    CHECK(run_program("report " + out.string(), environment).code ==
          1);  // a part does not pass for the whole
  }
  const Ended ended = run_program(command + " --resume", environment);
  INFO(ended.output);
  CHECK(ended.code == 0);
  CHECK(ended.output.find("of which 0 taken") == std::string::npos);
  CHECK(ended.output.find("of which 5 taken") == std::string::npos);
  CHECK(tables(out) == tables(whole));
}

TEST_CASE("there must be something to go on with") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("slow.toml", study);
  const std::string command = "run " + file + " --out " + (scratch.path() / "out").string() + " --resume";
  const std::string environment = "MPM_CACHE=" + (scratch.path() / "cache").string();
  CHECK(run_program(command, environment).code == 2);
  CHECK_THAT(run_program(command, environment).output, contains("no suite was begun here"));
  CHECK_THAT(run_program(command, "MPM_CACHE=").output, contains("MPM_CACHE"));
  CHECK(run_program(command + " --no-cache", environment).code == 2);
  CHECK(run_program("run --fresh --no-cache", environment).code == 2);
}

TEST_CASE("two results are compared: the same is no regression, a worse error is one") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("slow.toml", study);
  const auto out = scratch.path() / "out", worse = scratch.path() / "worse";
  const std::string environment = "MPM_CACHE=" + (scratch.path() / "cache").string();
  REQUIRE(run_program("run " + file + " --out " + out.string(), environment).code == 0);
  std::filesystem::copy(out, worse, std::filesystem::copy_options::recursive);
  const std::string pair = out.string() + " " + worse.string();
  Ended ended = run_program("compare " + pair);
  INFO(ended.output);
  CHECK(ended.code == 0);
  CHECK_THAT(ended.output, contains("no regression"));

  std::string errors = content_of(worse / "errors.csv");
  const auto line = errors.find("slow.a,0.1,grid,");
  REQUIRE(line != std::string::npos);
  errors.insert(line + std::string("slow.a,0.1,grid,").size(), "1");  // the first digit of L1
  scratch.write("worse/errors.csv", errors);
  ended = run_program("compare " + pair);
  CHECK(ended.code == 1);
  CHECK_THAT(ended.output, contains("WORSE   slow.a, t = 0.1 s, grid, l1: "));
  CHECK(run_program("compare " + out.string() + " " + (scratch.path() / "absent").string()).code == 2);
  CHECK(run_program("compare " + out.string()).code == 2);
}
