#pragma once

#include <gsl/gsl_errno.h>

namespace mpm {

/// GSL would end the program with its own message: from now on it says by what it returns that something
/// went wrong. Switched once, however many threads ask.
inline void quiet_gsl() {
  static gsl_error_handler_t* const previous = gsl_set_error_handler_off();
  static_cast<void>(previous);
}

}  // namespace mpm
