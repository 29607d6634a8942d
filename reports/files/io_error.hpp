#pragma once

#include <stdexcept>
#include <string>

namespace reports {

/// A file could not be read or written, or holds what it must not. what() is one line that names the file,
/// the reason and, where there is one, the remedy: fit to be printed as it is.
struct IoError : std::runtime_error {
  explicit IoError(const std::string& message, int number = 0) : std::runtime_error(message), error(number) {}
  int error;  ///< errno of the system call that failed; 0 for none
};

}  // namespace reports
