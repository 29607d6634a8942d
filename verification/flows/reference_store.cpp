#include "verification/flows/reference_store.hpp"

#include <algorithm>
#include <cstdlib>
#include <future>
#include <map>
#include <mutex>
#include <string>

#include "reference/channel/steady_channel.hpp"

namespace verification {

std::filesystem::path cache_directory() {
  if (const char* chosen = std::getenv("MPM_CACHE")) return chosen;
  // The XDG base directory specification: a relative path is invalid, and ignored.
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg == '/')
    return std::filesystem::path(xdg) / "mpm-verify";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".cache" / "mpm-verify";
  return {};
}

std::shared_ptr<const reference::ChannelSolution> channel_solution(const reference::ChannelProblem& problem) {
  using Solution = std::shared_ptr<const reference::ChannelSolution>;
  static std::mutex mutex;
  static std::map<std::string, std::shared_future<Solution>> solutions;
  std::promise<Solution> promise;
  std::shared_future<Solution> future;
  bool ours = false;
  {
    const std::scoped_lock lock(mutex);
    auto [entry, inserted] = solutions.try_emplace(problem.describe());
    if (inserted) entry->second = promise.get_future().share();
    ours = inserted;
    future = entry->second;
  }
  if (ours) {
    try {
      promise.set_value(reference::make_channel_solution(problem, cache_directory()));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  }
  return future.get();
}

SteadyScales steady_scales(const reference::ChannelProblem& problem) {
  static std::mutex mutex;
  static std::map<std::string, SteadyScales> kept;
  const std::string key = problem.describe_flow();
  {
    const std::scoped_lock lock(mutex);
    if (const auto found = kept.find(key); found != kept.end()) return found->second;
  }
  const reference::SteadyChannel steady(problem.height, problem.body_acceleration, problem.plate_velocity,
                                        problem.curve);
  const reference::SteadyChannel before(problem.height, problem.initial_acceleration, 0, problem.curve);
  const SteadyScales scales{std::max(steady.maximum(), before.maximum()), steady.mid_height_velocity()};
  const std::scoped_lock lock(mutex);
  return kept.try_emplace(key, scales).first->second;
}

}  // namespace verification
