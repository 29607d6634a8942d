#include "reference/channel/channel_factory.hpp"

#include "reference/channel/newtonian_channel.hpp"
#include "reference/transient/transient_channel.hpp"

namespace reference {

std::unique_ptr<ChannelSolution> make_channel_solution(const ChannelProblem& problem,
                                                       const std::filesystem::path& cache_directory) {
  problem.check();
  if (const auto nu = problem.curve.newtonian()) {
    return std::make_unique<NewtonianChannel>(
        NewtonianChannelParameters{problem.height, *nu, problem.body_acceleration, problem.plate_velocity});
  }
  return std::make_unique<TransientChannel>(problem, cache_directory);
}

}  // namespace reference
