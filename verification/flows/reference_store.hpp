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

/// Of the steady flow of a problem between plates, and of the one before it.
struct SteadyScales {
  double maximum;     ///< the faster of the two [m/s]
  double mid_height;  ///< velocity at mid-height of the later one [m/s]
};
/// Integrals of the flow curve, taken once a process: a study makes a flow for each of its runs. Throws
/// std::invalid_argument, as SteadyChannel does.
SteadyScales steady_scales(const reference::ChannelProblem& problem);

}  // namespace verification
