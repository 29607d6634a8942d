#pragma once

#include <filesystem>
#include <memory>

#include "reference/channel/channel_problem.hpp"
#include "reference/channel/channel_solution.hpp"

namespace reference {

/// The best solution there is for a channel's start-up: NewtonianChannel's exact series if the curve is
/// Newtonian (whatever its model: a = 1, n = 1, nu_0 = nu_inf), else a TransientChannel, cached in
/// `cache_directory` unless that is empty. Throws what these throw.
std::unique_ptr<ChannelSolution> make_channel_solution(const ChannelProblem& problem,
                                                       const std::filesystem::path& cache_directory = {});

}  // namespace reference
