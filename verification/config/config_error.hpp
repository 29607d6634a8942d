#pragma once

#include <stdexcept>

namespace verification {

/// The user's mistake: a file, key or argument that cannot be used. The message names it and the remedy; exit
/// code 2.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace verification
