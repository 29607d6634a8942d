#include "reports/process/child.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"

using namespace reports;

namespace {

ChildCommand shell(const ScratchDirectory& scratch, const std::string& script) {
  ChildCommand command;
  command.arguments = {"sh", "-c", script};
  command.directory = scratch.path();
  command.log = scratch / "log";
  return command;
}

/// Whether a process is there and is no corpse that nobody has fetched yet.
bool lives(const std::string& pid) {
  const std::string state = content_of("/proc/" + pid + "/stat");
  return !state.empty() && state.find(") Z") == std::string::npos;
}

bool ends_soon(const std::string& pid) {
  for (int i = 0; i < 100 && lives(pid); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  return !lives(pid);
}

}  // namespace

TEST_CASE("a child runs where it is told, with its variables, and says how it ended") {
  const ScratchDirectory scratch;
  ChildCommand command = shell(scratch, "pwd; echo $GREETING; echo bad >&2; exit 3");
  command.environment["GREETING"] = "hello";
  const ChildEnd end = run_child(command);
  CHECK(end.exit_code == 3);
  CHECK_FALSE(end.well());
  CHECK_THAT(end.text(), contains("exit code 3 after "));
  CHECK(last_lines(command.log, 2) == "hello\nbad");
  CHECK_THAT(content_of(command.log), contains(std::filesystem::canonical(scratch.path()).string()));

  CHECK_THAT(run_child(shell(scratch, "kill -SEGV $$")).text(), contains("signal 11"));
  command.arguments = {"no-such-program-anywhere"};
  CHECK_THAT(run_child(command).text(), contains("could not be started: no-such-program-anywhere"));
}

TEST_CASE("a child that takes too long is ended with all that it started, even if it ignores SIGTERM") {
  const ScratchDirectory scratch;
  ChildCommand command =
      shell(scratch, "trap '' TERM; sleep 60 & echo $! > inner; echo $$ > outer; while :; do sleep 1; done");
  command.timeout = 0.3;
  const auto begin = std::chrono::steady_clock::now();
  const ChildEnd end = run_child(command);
  CHECK(end.timed_out);
  CHECK_THAT(end.text(), contains("no end within 0.3"));
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));
  for (const char* file : {"inner", "outer"}) {
    std::string pid = content_of(scratch / file);
    REQUIRE(!pid.empty());
    pid.pop_back();
    CHECK(ends_soon(pid));
  }
}

TEST_CASE("a child that is stopped, or leaves something behind, leaves no orphan") {
  const ScratchDirectory scratch;
  ChildCommand command = shell(scratch, "sleep 60 & echo $! > inner; exit 0");
  CHECK(run_child(command).well());
  std::string pid = content_of(scratch / "inner");
  pid.pop_back();
  CHECK(ends_soon(pid));

  command = shell(scratch, "sleep 60");
  command.stop = [] { return true; };
  const ChildEnd end = run_child(command);
  CHECK(end.stopped);
  CHECK(end.seconds < 5);
}

TEST_CASE("a child does not outlive a process that was killed outright") {
  const ScratchDirectory scratch;
  const pid_t parent = fork();
  if (parent == 0) {
    run_child(shell(scratch, "echo $$ > started; mv started inner; exec sleep 60"));
    _exit(0);
  }
  const std::filesystem::path inner = scratch / "inner";
  for (int i = 0; i < 250 && !std::filesystem::exists(inner); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::string pid = content_of(inner);
  REQUIRE(!pid.empty());
  pid.pop_back();
  CHECK(lives(pid));
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  CHECK(ends_soon(pid));
}

TEST_CASE("a command as typed is split as a shell would, and refused where it needs one") {
  CHECK(split_command("solver  --at '{out} here' \"a b\"c") ==
        std::vector<std::string>{"solver", "--at", "{out} here", "a bc"});
  CHECK(split_command("  ").empty());
  CHECK(split_command("a ''") == std::vector<std::string>{"a", ""});
  for (const char* text : {"a | b", "a > log", "a; b", "a $HOME", "a 'b", "a `b`", "a &"})
    CHECK_THROWS_AS(split_command(text), std::invalid_argument);
  CHECK(split_command("a '|'") == std::vector<std::string>{"a", "|"});
}
