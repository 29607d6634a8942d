#include "tests/catch.hpp"
#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

namespace {

const std::string study = study_text(
    "Tiny", "A tiny study",
    couette_scene() + "[[check]]\nkind = \"error\"\nupper = 1.0\nreason = \"machinery, not accuracy\"\n");

/// How a command line of a shell ended, with {} for the program.
int shell(std::string line) {
  for (std::size_t at; (at = line.find("{}")) != std::string::npos;) line.replace(at, 2, MPM_VERIFY_PROGRAM);
  const int status = std::system(("( " + line + " )").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("closed and full streams: no crash, no message in a table, one end for all commands") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("tiny.toml", study),
                    scene = scratch.write("plate.toml", couette_scene());
  const std::string whole = (scratch / "whole").string(), out = (scratch / "out").string();
  REQUIRE(shell("{} run " + file + " --no-cache --out " + whole + " > /dev/null 2>&1") == 0);
  const std::string checks = content_of(scratch / "whole/checks.csv");

  for (const char* streams : {"2>&-", ">&- 2>&-", "<&- >&- 2>&-", "> /dev/null 2> /dev/full"}) {
    INFO(streams);
    std::filesystem::remove_all(out);
    CHECK(shell("{} run " + file + " --no-cache --out " + out + " > /dev/null " + streams) == 0);
    CHECK(content_of(scratch / "out/checks.csv") == checks);
    CHECK(content_of(scratch / "out/profiles/tiny.csv") == content_of(scratch / "whole/profiles/tiny.csv"));
  }
  // A message that cannot be written changes no exit code.
  CHECK(shell("{} run no-such-study 2> /dev/full") == 2);
  CHECK(shell("{} run no-such-study 2>&-") == 2);
  // Nor does a reader of messages that goes away.
  CHECK(shell("{ {} run no-such-study; echo $? > " + (scratch / "code").string() +
              "; } 2>&1 | true; grep -q 2 " + (scratch / "code").string()) == 0);

  for (const std::string& command : std::initializer_list<std::string>{
           "run " + file + " --out " + out, "list", "report " + whole, "compare " + whole + " " + whole,
           "solve " + scene + " --out " + (scratch / "solved").string(),
           "reference " + scene + " --out " + (scratch / "exact").string(), "--help", "--version"}) {
    INFO(command);
    CHECK(shell("{} " + command + " > /dev/full 2> " + (scratch / "said").string()) == 2);
    CHECK_THAT(content_of(scratch / "said"), contains("the output could not be written"));
  }
}

TEST_CASE("no escape codes for a terminal that knows none") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("tiny.toml", study);
  if (std::system("command -v script > /dev/null") != 0) return;  // the one way to a terminal here
  for (const char* term : {"dumb", "xterm"}) {
    INFO(term);
    const std::string said = (scratch / term).string();
    CHECK(shell("TERM=" + std::string(term) + " script -qec '{} run " + file + " --out " +
                (scratch / "out").string() + "' /dev/null > " + said + " 2>&1") == 0);
    CHECK((content_of(said).find('\033') != std::string::npos) == (std::string(term) == "xterm"));
  }
}
