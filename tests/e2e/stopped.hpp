#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <thread>

#include "tests/scratch_directory.hpp"

/// All CSV files by name, but timing.csv and changes.csv, which says what lay there before.
inline std::map<std::string, std::string> tables(const std::filesystem::path& root) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
    if (entry.path().extension() == ".csv" && entry.path().filename() != "timing.csv" &&
        entry.path().filename() != "changes.csv")
      files[std::filesystem::relative(entry.path(), root).string()] = content_of(entry.path());
  return files;
}

/// Starts the program, waits until it has kept `runs` runs in the cache, and sends it a signal. Returns how
/// it ended, as a shell would say it.
inline int stop_after(int runs, int signal, const std::string& arguments,
                      const std::filesystem::path& cache) {
  const pid_t child = fork();
  if (child == 0) {
    setenv("MPM_CACHE", cache.c_str(), 1);
    const std::string command =
        std::string("exec ") + MPM_VERIFY_PROGRAM + " " + arguments + " >/dev/null 2>&1";
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  for (int kept = 0; kept < runs && waitpid(child, &status, WNOHANG) == 0;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::error_code error;
    kept = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(cache / "runs", error))
      kept += entry.path().extension() == ".run";
  }
  kill(child, signal);
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}
