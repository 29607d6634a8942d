#include "reference/channel/channel_factory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reference/channel/newtonian_channel.hpp"
#include "reference/channel/steady_channel.hpp"
#include "reference/transient/transient_channel.hpp"

namespace reference {
namespace {

/// A Newtonian flow that is steady under one body acceleration until another replaces it: start-ups add up.
class NewtonianChange final : public ChannelSolution {
 public:
  NewtonianChange(double height, double nu, double before, double after)
      : before_(before),
        after_(after),
        unit_({height, nu, 1.0, 0.0}),
        profile_(height, 1.0, 0.0, NewtonianCurve{nu}),
        maximum_(std::max(std::abs(before), std::abs(after)) * profile_.maximum()) {}

  [[nodiscard]] double velocity(double y, double t) const override {
    return before_ * profile_.velocity(y) + (after_ - before_) * unit_.velocity(y, t);
  }
  [[nodiscard]] double gradient(double y, double t) const override {
    return before_ * profile_.gradient(y) + (after_ - before_) * unit_.gradient(y, t);
  }
  [[nodiscard]] double steady_maximum() const override { return maximum_; }
  [[nodiscard]] double stated_error() const override { return 2.0 * unit_.stated_error(); }
  [[nodiscard]] std::string description() const override {
    return fmt::format("steady flow under {:g} m/s2 that {:g} m/s2 replaces; exact: {}", before_, after_,
                       unit_.description());
  }

 private:
  double before_, after_;
  NewtonianChannel unit_;
  SteadyChannel profile_;
  double maximum_;
};

}  // namespace

std::unique_ptr<ChannelSolution> make_channel_solution(const ChannelProblem& problem,
                                                       const std::filesystem::path& cache_directory) {
  problem.check();
  if (const auto nu = problem.curve.newtonian()) {
    if (problem.initial_acceleration != 0.0)
      return std::make_unique<NewtonianChange>(problem.height, *nu, problem.initial_acceleration,
                                               problem.body_acceleration);
    return std::make_unique<NewtonianChannel>(
        NewtonianChannelParameters{problem.height, *nu, problem.body_acceleration, problem.plate_velocity});
  }
  return std::make_unique<TransientChannel>(problem, cache_directory);
}

}  // namespace reference
