#pragma once

#include <string>

#include "verification/study/study.hpp"

namespace verification {

/// What its version command prints, asked for once a process: the first line that is not empty. "" for a
/// solver that has no such command. Throws std::runtime_error when the command fails or
/// prints nothing.
std::string version_of(const ForeignSolver& solver);

/// All that decides what a foreign run delivers, as text: the scene handed on with its options, the command
/// with the content of every file that it names, the environment, the content of the inputs, the version,
/// what is to be delivered. "" for a run that may not be kept (ForeignSolver::remembered).
std::string what_decides(const PlannedRun& plan, const std::string& version);

}  // namespace verification
