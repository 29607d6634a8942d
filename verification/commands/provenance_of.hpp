#pragma once

#include <string>

#include "build_info.hpp"
#include "reports/provenance.hpp"

namespace verification {

/// Build, machine, command line and the time, now.
inline reports::Provenance provenance_of(const std::string& command_line) {
  return {{build_info::version, build_info::commit, build_info::compiler, build_info::flags,
           build_info::build_type},
          reports::this_machine(),
          command_line,
          reports::utc_now()};
}

}  // namespace verification
