#pragma once

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace verification {

/// Whether the terminal knows escape codes at all.
inline bool knows_escape_codes() {
  const char* term = std::getenv("TERM");
  return term && *term && std::string_view(term) != "dumb";
}

/// Colour is for a terminal whose user has not said NO_COLOR (no-color.org).
inline bool use_colour() {
  const char* no_color = std::getenv("NO_COLOR");
  return isatty(STDOUT_FILENO) && knows_escape_codes() && !(no_color && *no_color);
}

/// Progress belongs on a terminal; a log gets none.
inline bool show_progress() {
  return isatty(STDERR_FILENO) && knows_escape_codes();
}

}  // namespace verification
