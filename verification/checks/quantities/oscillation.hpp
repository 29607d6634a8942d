#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "verification/flows/flow.hpp"

namespace verification {

/// A scalar [any unit] against time [s].
struct Signal {
  std::vector<double> t, value;
};

/// Least-squares fit of exp(-g t)(A cos(w t) + B sin(w t)) to a signal, all four free: w and g of the best
/// fit. Searched for within half and one and a half times `expected`.angular_frequency, so that a wrong
/// period is found and told, then refined by Gauss-Newton; none for fewer than eight points, or when nothing
/// oscillates there.
std::optional<Oscillation> fit_damped_oscillation(const Signal& signal, const Oscillation& expected);

/// Least-squares fit of m + Re[C exp(i w t)] to a signal at a known w [rad/s]: the complex amplitude C; none
/// for fewer than eight points.
std::optional<std::complex<double>> fit_harmonic(const Signal& signal, double angular_frequency);

}  // namespace verification
