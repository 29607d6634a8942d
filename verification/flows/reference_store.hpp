#pragma once

#include <filesystem>
#include <memory>

#include "reference/channel/channel_factory.hpp"

namespace verification {

/// Where computed references, finished runs and drawn figures are kept: $MPM_CACHE, else
/// $XDG_CACHE_HOME/mpm-verify, else ~/.cache/mpm-verify; empty (no cache) when MPM_CACHE is set to nothing or
/// there is no home.
std::filesystem::path cache_directory();

/// The reference solution of a problem. Every problem is solved once a process, whoever asks; threads that
/// ask while it is being solved wait for it.
std::shared_ptr<const reference::ChannelSolution> channel_solution(const reference::ChannelProblem& problem);

}  // namespace verification
