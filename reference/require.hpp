#pragma once

#include <stdexcept>
#include <string>

namespace reference {

/// Throws std::invalid_argument with `message` unless `condition` holds (so a NaN in a comparison is refused
/// too).
inline void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

}  // namespace reference
