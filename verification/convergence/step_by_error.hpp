#pragma once

#include <vector>

// The largest time step whose error stays a stated fraction of the error in space. All errors are relative
// norms; steps in s, cells in m.
namespace verification {

/// e = coefficient * step^order.
struct PowerLaw {
  double coefficient = 0, order = 0;

  [[nodiscard]] double at(double step) const;
  /// The step at which it takes a value.
  [[nodiscard]] double inverse(double value) const;
};

/// What three steps on one mesh say of the error in time.
struct TimeError {
  enum class Kind {
    Law,       ///< it falls with dt, by the law
    RoundOff,  ///< nothing but round-off: there is no error to speak of
    NoOrder    ///< halving the step does not make it fall as an order would
  };
  Kind kind = Kind::NoOrder;
  double observed_order = 0;  ///< log2 of the ratio of the two differences; NaN where they are round-off
  PowerLaw law;               ///< of Kind::Law
};

/// From the norms of u(dt) - u(dt/2) and u(dt/2) - u(dt/4) on one mesh, in which the error in space drops
/// out: with e = C dt^q the first is C dt^q (1 - 2^-q), and their ratio is 2^q (Richardson). The law goes
/// through the first, the larger, and its order is the observed one but at most `formal_order`: either way
/// smaller steps are not thought better than they are. Differences of at most `round_off` are none; an
/// observed order below half the formal one, and anything that is not finite, is no order.
TimeError time_error_of(double dt, double first, double second, double formal_order, double round_off);

/// Order in space from the errors on two meshes, and never less than theory's (NaN: none is known): a step
/// that is too short costs a little, one that is too long spoils the order.
PowerLaw space_error_of(double coarse, double coarse_error, double fine, double fine_error,
                        double theoretical);

/// What a step was bounded by.
enum class StepBound { Error, Stability, Outputs, Pilot, None };
/// "error", "stability", "outputs", "pilot", "none".
const char* name(StepBound bound);

struct ChosenStep {
  double dt = 0;
  StepBound bound = StepBound::None;
};

/// Largest step that divides `interval` into equal parts and is neither above the one at which `time` is
/// `target`, nor above `stable`, nor above `tried` (what a diverged pilot left standing); both may be
/// infinite. `interval`: the longest one that divides all the intervals between outputs.
ChosenStep step_by_error(const PowerLaw& time, double target, double stable, double tried, double interval);
/// The same where there is no error in time.
ChosenStep step_by_bounds(double stable, double tried, double interval);

/// Longest interval of which every one between neighbouring outputs (increasing, after `begin`) is a whole
/// multiple; where that is below a twentieth of the shortest, the shortest itself.
double common_interval(double begin, const std::vector<double>& outputs);

}  // namespace verification
