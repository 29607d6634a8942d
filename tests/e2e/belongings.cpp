#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "tests/catch.hpp"
#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

namespace {

const std::string study = study_text(
    "Tiny", "A tiny study",
    couette_scene() + "[[check]]\nkind = \"error\"\nupper = 1.0\nreason = \"machinery, not accuracy\"\n");

}  // namespace

TEST_CASE("a directory of somebody else's is not written into, unless forced") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("tiny.toml", study),
                    scene = scratch.write("plate.toml", couette_scene());
  std::filesystem::create_directories(scratch / "theirs/profiles");
  scratch.write("theirs/report.md", "my report\n");
  scratch.write("theirs/draft.tmp", "my draft\n");
  scratch.write("theirs/profiles/x.1.2.tmp", "left by a killed program of ours\n");
  scratch.write("target.7.8.tmp", "elsewhere\n");
  std::filesystem::create_symlink(scratch / "target.7.8.tmp", scratch / "theirs/link.7.8.tmp");
  const std::string out = " --out " + (scratch / "theirs").string();
  for (const std::string& command : {"run " + file, "solve " + scene, "reference " + scene}) {
    const Ended ended = run_program(command + out);
    INFO(ended.output);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.output, contains("no results of ours"));
    CHECK_THAT(ended.output, contains("--force"));
    CHECK(content_of(scratch / "theirs/report.md") == "my report\n");
  }
  CHECK(run_program("run " + file + out + " --force").code == 0);
  CHECK(content_of(scratch / "theirs/draft.tmp") == "my draft\n");
  CHECK(std::filesystem::is_symlink(scratch / "theirs/link.7.8.tmp"));
  CHECK(content_of(scratch / "target.7.8.tmp") == "elsewhere\n");
  CHECK_FALSE(std::filesystem::exists(scratch / "theirs/profiles/x.1.2.tmp"));
  CHECK(run_program("run " + file + out).code == 0);  // ours by now
  scratch.write("theirs/provenance.json", "{\"who\": \"somebody else\"}\n");
  CHECK(run_program("run " + file + out).code == 2);
}

TEST_CASE("two runs into one directory: the second is told who is there, and leaves it alone") {
  const ScratchDirectory scratch;
  const std::string slow = scratch.write("slow.toml", replaced(replaced(study, "dt = 2e-3", "dt = 2e-6"),
                                                               "cells = 8", "cells = 16\ncells_along = 16"));
  const std::string out = (scratch / "out").string();
  const pid_t child = fork();
  if (child == 0) {
    const std::string command =
        "exec " + std::string(MPM_VERIFY_PROGRAM) + " run " + slow + " --no-cache --out " + out;
    execl("/bin/sh", "sh", "-c", (command + " > /dev/null 2>&1").c_str(), nullptr);
    _exit(127);
  }
  for (int wait = 0; wait < 2000 && !std::filesystem::exists(scratch / "out/provenance.json"); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const std::string begun = content_of(scratch / "out/provenance.json");
  const Ended second = run_program("run " + scratch.write("tiny.toml", study) + " --out " + out);
  INFO(second.output);
  CHECK(second.code == 2);
  CHECK_THAT(second.output,
             contains("another run is using " + out + " (process " + std::to_string(child) + ")"));
  CHECK(content_of(scratch / "out/provenance.json") == begun);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  // The lock goes with the process, however it ended.
  CHECK(run_program("run " + (scratch / "tiny.toml").string() + " --out " + out).code == 0);
}

TEST_CASE("a cache that points at a user's directory takes nothing away and waits for nothing") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("tiny.toml", study);
  const std::string cache = (scratch / "home").string(), environment = "timeout 60 env MPM_CACHE=" + cache;
  const std::string out = " --out " + (scratch / "out").string();
  REQUIRE(run_program("run " + file + out, environment).code == 0);
  // Every entry becomes a FIFO, or a link to what has no end: as good as none, and no reason to hang.
  bool link = false;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(cache)) {
    if (!entry.is_regular_file()) continue;
    std::filesystem::remove(entry.path());
    if ((link = !link))
      std::filesystem::create_symlink("/dev/zero", entry.path());
    else
      REQUIRE(mkfifo(entry.path().c_str(), 0600) == 0);
  }
  const Ended ended = run_program("run " + file + out, environment);
  INFO(ended.output);
  CHECK(ended.code == 0);
}

TEST_CASE("a limit on processes makes it slower, not fail") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("tiny.toml", study);
  // Threads count; root is exempt, and then this says little.
  const Ended ended = run_program("run " + file + " --jobs 8 --threads 4 --out " + (scratch / "out").string(),
                                  "ulimit -u 64 2> /dev/null; MPM_CACHE=");
  INFO(ended.output);
  CHECK(ended.code != 3);
}

TEST_CASE("a relative XDG_CACHE_HOME is ignored, and denied is not told as full") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("tiny.toml", study);
  const std::string in = "cd " + scratch.path().string() + " && HOME=" + (scratch / "home").string();
  const std::string out = " --out " + (scratch / "out").string();
  CHECK(run_program("run " + file + out, in + " XDG_CACHE_HOME=relative env -u MPM_CACHE").code == 0);
  CHECK_FALSE(std::filesystem::exists(scratch / "relative"));
  CHECK(std::filesystem::exists(scratch / "home/.cache/mpm-verify/runs"));
  const Ended blocked = run_program("run " + file + out, "MPM_CACHE=" + scratch.write("occupied", ""));
  CHECK_THAT(blocked.output, contains("(Not a directory)"));
  CHECK(blocked.output.find("free some space") == std::string::npos);
}
