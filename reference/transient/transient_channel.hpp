#pragma once

#include <filesystem>
#include <string>

#include "reference/channel/channel_problem.hpp"
#include "reference/channel/channel_solution.hpp"
#include "reference/transient/transient_solution.hpp"

namespace reference {

/// What problems have in common that one computation serves, the one with the latest time: the flow, and when
/// it has to be accurate from.
std::string transient_name(const ChannelProblem& problem);

/// Start-up of a channel of any fluid with a monotone flow curve, computed (see TransientSolution) twice,
/// with a coarse and a fine resolution; the fine one is offered, and twice their difference is the stated
/// error. For pure Poiseuille and pure Couette start-up that is well below 1e-9 in velocity; combined flows
/// of fluids whose flow curve has a kink or worse at zero shear (Cross, power law) reach 1e-5 to 1e-8, as the
/// zero-shear point moves.
class TransientChannel : public ChannelSolution {
 public:
  /// Computes the solution, or loads it from `cache_directory` if an earlier one of the same transient_name
  /// that reached as far was left there (empty: no cache): the numbers are the same. The key is every
  /// parameter and the format version; unreadable or damaged files are ignored, and a cache that cannot be
  /// written costs nothing but time. Throws std::invalid_argument for a bad problem
  /// (see ChannelProblem, FlowCurve; at least one positive time; not a Newtonian curve, for which
  /// NewtonianChannel is exact) and std::runtime_error if the implicit steps fail to converge.
  explicit TransientChannel(const ChannelProblem& problem, const std::filesystem::path& cache_directory = {});

  /// Any 0 <= t <= the last of the problem's times, listed or not; the error is stated for the listed ones,
  /// so a very early time among them raises it.
  [[nodiscard]] double velocity(double y, double t) const override { return solution_.velocity(y, t); }
  [[nodiscard]] double gradient(double y, double t) const override { return solution_.gradient(y, t); }
  [[nodiscard]] double steady_maximum() const override { return steady_maximum_; }
  [[nodiscard]] double stated_error() const override { return velocity_error_; }
  /// Bound on |error of gradient| over the largest |gradient| at the same time.
  [[nodiscard]] double stated_gradient_error() const { return gradient_error_; }
  [[nodiscard]] std::string description() const override;

  /// Whether this object was read from the cache.
  [[nodiscard]] bool from_cache() const { return from_cache_; }

 private:
  void compare(const TransientSolution& coarse);

  ChannelProblem problem_;
  TransientSolution solution_;
  double steady_maximum_;
  double velocity_error_ = 0.0, gradient_error_ = 0.0;
  bool from_cache_ = false;
};

}  // namespace reference
