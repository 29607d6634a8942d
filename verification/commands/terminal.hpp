#pragma once

#include <unistd.h>

#include <cstdlib>

namespace verification {

/// Colour is for a terminal whose user has not said NO_COLOR (no-color.org).
inline bool use_colour() {
  const char* no_color = std::getenv("NO_COLOR");
  return isatty(STDOUT_FILENO) && !(no_color && *no_color);
}

/// Progress belongs on a terminal; a log gets none.
inline bool show_progress() {
  return isatty(STDERR_FILENO);
}

}  // namespace verification
