#pragma once

#include <string>

namespace verification {

/// What computes: a hash of this program's executable file, of the shared libraries that it has loaded (path,
/// size, time of change) and of the processor's name. Code, compiler, flags and libraries that could change a
/// result change it. "" where the executable cannot be read: then nothing may be remembered.
const std::string& build_identity();

/// The same of the executable file alone: what machines that share a suite must share. "" likewise.
const std::string& program_identity();

}  // namespace verification
