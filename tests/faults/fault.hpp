#pragma once

#include <cstdlib>
#include <cstring>

/// Included before everything in the files of its copy of the source that plant-faults plants faults in.
namespace mpm_faults {

/// The fault that this process has; "" for none.
inline const char* chosen() {
  static const char* const name = [] {
    const char* const asked = std::getenv("MPM_FAULT");
    return asked ? asked : "";
  }();
  return name;
}

/// Whether the fault of this name is on: decided once at every place.
#define MPM_FAULT_ON(name)                                               \
  ([] {                                                                  \
    static const bool on = std::strcmp(mpm_faults::chosen(), name) == 0; \
    return on;                                                           \
  }())

}  // namespace mpm_faults
