#pragma once

#include <gsl/gsl_errno.h>

namespace reference {

/// GSL aborts the program on an error unless told otherwise; underflow to zero is among those errors. Called
/// before any GSL function that may report one: from then on GSL returns its error codes.
inline void quiet_gsl() {
  static gsl_error_handler_t* const previous = gsl_set_error_handler_off();
  (void)previous;
}

}  // namespace reference
