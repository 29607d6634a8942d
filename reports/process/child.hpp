#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace reports {

/// A program to run: gnuplot, a browser, somebody else's solver.
struct ChildCommand {
  std::vector<std::string> arguments;  ///< the program first, looked for on PATH; no shell reads them
  std::filesystem::path directory;     ///< it starts here; "" for ours
  std::map<std::string, std::string> environment;  ///< over ours
  std::filesystem::path log;   ///< receives both of its streams, from empty; "" for nowhere
  double timeout = 60;         ///< [s]; then it is ended, and what it started
  std::function<bool()> stop;  ///< asked all the while: true ends it; empty for never
};

/// How it ended.
struct ChildEnd {
  int exit_code = -1;      ///< -1 unless it returned by itself
  int signal = 0;          ///< that ended it; 0 for none
  bool timed_out = false;  ///< `timeout` had passed
  bool stopped = false;    ///< `stop` said so
  double seconds = 0;      ///< that it ran
  std::string error;       ///< why it could not be started; "" when it was

  [[nodiscard]] bool well() const { return exit_code == 0 && !timed_out && !stopped && error.empty(); }
  /// "exit code 3 after 0.2 s", "signal 11 (Segmentation fault) after 4.1 s", "no end within 60 s", ...
  [[nodiscard]] std::string text() const;
  /// The same without the time that it took, which no two runs share: for tables.
  [[nodiscard]] std::string cause() const;
};

/// Runs a program to its end in a process group of its own, with no standard input. Whatever way it ends,
/// nothing of the group is left: SIGTERM first, SIGKILL a second later.
ChildEnd run_child(const ChildCommand& command);

/// Makes SIGINT, SIGTERM and SIGHUP end the children that run, and then the program as they always did:
/// children have process groups of their own, which a terminal's Ctrl-C does not reach. Call once, at the
/// start.
void end_children_on_signals();

/// The end of a text file, at most `lines` lines and 4 kB of it, for a message; "" where there is none.
std::string last_lines(const std::filesystem::path& file, std::size_t lines);

/// Splits a command as typed into its arguments: at white space, with '...' and "..." for what holds any.
/// @throws std::invalid_argument where it asks for a shell (| > < ; & $ ` * ? ~ outside quotes) or leaves a
/// quote open.
std::vector<std::string> split_command(const std::string& text);

}  // namespace reports
