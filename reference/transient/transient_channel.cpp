#include "reference/transient/transient_channel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/channel/steady_channel.hpp"
#include "reference/require.hpp"
#include "reference/transient/transient_cache.hpp"

namespace reference {
namespace {

// The fine solution errs four times less than the difference where time steps dominate, and about as much as
// the difference where a moving bend of the flow curve does; between the sampled heights it may err a little
// more.
constexpr double kSafety = 2.0;
constexpr double kFloor = 1e-12;  // round-off of the closed forms and of a few hundred steps

const ChannelProblem& checked(const ChannelProblem& problem) {
  problem.check();
  require(problem.first_time() > 0.0, "transient channel: at least one positive time is needed");
  require(!problem.curve.newtonian(), "transient channel: a Newtonian fluid has an exact solution; use that");
  return problem;
}

std::string describe(const TransientResolution& r) {
  return fmt::format("degree={} tolerance={:g} smallest={:g} neglected={:g}", r.degree, r.tolerance,
                     r.smallest, r.neglected);
}

double steady_maximum_of(const ChannelProblem& p) {
  if (p.pull != 0.0) return std::abs(p.curve.rate(p.pull)) * p.height;
  return std::max(SteadyChannel(p.height, p.body_acceleration, p.plate_velocity, p.curve).maximum(),
                  SteadyChannel(p.height, p.initial_acceleration, 0.0, p.curve).maximum());
}

}  // namespace

std::string transient_name(const ChannelProblem& problem) {
  return fmt::format("{} from={:.17g}", problem.describe_flow(), problem.accurate_from());
}

TransientChannel::TransientChannel(const ChannelProblem& problem,
                                   const std::filesystem::path& cache_directory)
    : problem_(checked(problem)),
      solution_(problem, fine_resolution(problem)),
      steady_maximum_(steady_maximum_of(problem)) {
  const std::string key = fmt::format("{} {} {}", transient_name(problem), describe(fine_resolution(problem)),
                                      describe(coarse_resolution(problem)));
  TransientSolution coarse(problem, coarse_resolution(problem));
  const auto cached = load_transient(cache_directory, key);
  from_cache_ = cached && solution_.adopt(cached->fine) && coarse.adopt(cached->coarse);
  if (!from_cache_) {
    coarse.solve();
    solution_.solve();
    save_transient(cache_directory, key, {solution_.snapshots(), coarse.snapshots()});
  }
  compare(coarse);
}

void TransientChannel::compare(const TransientSolution& coarse) {
  constexpr int kHeights = 96, kTimes = 48;
  std::vector<double> times;
  std::copy_if(problem_.times.begin(), problem_.times.end(), std::back_inserter(times),
               [](double t) { return t > 0.0; });
  std::sort(times.begin(), times.end());
  // A flow that dies out has no largest gradient to compare with in the end; the start's is as good.
  const double least = problem_.initial_acceleration == 0.0 ? 0.0 : std::abs(solution_.gradient(0.0, 0.0));
  const std::size_t stride = (times.size() + kTimes - 1) / kTimes;
  for (std::size_t k = 0; k < times.size(); k += stride) {
    const double t = times[times.size() - 1 - k];
    double velocity = 0.0, gradient = 0.0, largest = least;
    for (int i = 0; i <= kHeights; ++i) {
      // Denser towards the walls, where the layers are, and with the middle among them.
      const double y = 0.5 * problem_.height * (1.0 - std::cos(std::numbers::pi * i / kHeights));
      const double w = solution_.gradient(y, t);
      velocity = std::max(velocity, std::abs(solution_.velocity(y, t) - coarse.velocity(y, t)));
      gradient = std::max(gradient, std::abs(w - coarse.gradient(y, t)));
      largest = std::max(largest, std::abs(w));
    }
    velocity_error_ = std::max(velocity_error_, velocity / steady_maximum_);
    gradient_error_ = std::max(gradient_error_, gradient / largest);
  }
  velocity_error_ = kSafety * velocity_error_ + kFloor;
  gradient_error_ = kSafety * gradient_error_ + kFloor;
}

std::string TransientChannel::description() const {
  if (problem_.pull != 0.0)
    return fmt::format(
        "transient reference (spectral elements, Radau IIA): H = {:g} m, pulled by {:g} m2/s2, {}; stated "
        "error "
        "{:.1e}",
        problem_.height, problem_.pull, problem_.curve.describe(), velocity_error_);
  return fmt::format(
      "transient reference (spectral elements, Radau IIA): H = {:g} m, F = {:g} m/s2, V0 = {:g} m/s, {}; "
      "stated "
      "error {:.1e}",
      problem_.height, problem_.body_acceleration, problem_.plate_velocity, problem_.curve.describe(),
      velocity_error_);
}

}  // namespace reference
