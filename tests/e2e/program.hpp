#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/scratch_directory.hpp"

/// What the program printed (both streams) and how it ended.
struct Ended {
  int code;
  std::string output;
};

/// Runs mpm-verify with arguments (quote them for a shell); `environment` goes before it, e.g.
/// "MPM_GNUPLOT=none".
inline Ended run_program(const std::string& arguments, const std::string& environment = "") {
  const ScratchDirectory scratch;
  const std::filesystem::path log = scratch.path() / "log";
  const std::string command =
      environment + " " + MPM_VERIFY_PROGRAM + " " + arguments + " > " + log.string() + " 2>&1";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(log)};
}
