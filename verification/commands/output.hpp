#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

// What the program says. A line for the user never decides the fate of a run: an error of the stream is
// remembered by it and told at the end (finish_output).
namespace verification {

/// To standard output.
template <class... T>
void say(fmt::format_string<T...> text, T&&... values) {
  const std::string line = fmt::format(text, std::forward<T>(values)...);
  std::fwrite(line.data(), 1, line.size(), stdout);
}

/// To standard error; what cannot be written there is lost.
template <class... T>
void warn(fmt::format_string<T...> text, T&&... values) {
  const std::string line = fmt::format(text, std::forward<T>(values)...);
  std::fwrite(line.data(), 1, line.size(), stderr);
}

/// Opens /dev/null for those of the descriptors 0 to 2 that are closed, so that no file of ours gets their
/// number and no message lands in it; and makes writing to a closed pipe an error instead of the end.
/// Children are not affected.
void hold_standard_streams();

/// The exit code of a command that ended with `code`: 2, with a message, if its standard output could not be
/// written. A signal's code stays.
int finish_output(int code);

}  // namespace verification
