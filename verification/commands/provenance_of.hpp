#pragma once

#include <string>

#include "build_info.hpp"
#include "reports/records/provenance.hpp"
#include "solver/kernel/isa.hpp"

namespace verification {

/// Build, the instruction set that the solver uses, machine, command line and the time, now.
inline reports::Provenance provenance_of(const std::string& command_line) {
  return {{build_info::version, build_info::commit, build_info::compiler,
           std::string(build_info::flags) + "; vector kernels " + mpm::current_isa(), build_info::build_type},
          reports::this_machine(),
          command_line,
          reports::utc_now()};
}

}  // namespace verification
