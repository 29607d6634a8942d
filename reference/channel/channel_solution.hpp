#pragma once

#include <string>

namespace reference {

/// A unidirectional flow u(y, t) between parallel plates at y = 0 (at rest) and y = H: what every exact or
/// reference solution of a channel offers. SI units throughout.
class ChannelSolution {
 public:
  virtual ~ChannelSolution() = default;

  /// Streamwise velocity u(y, t) [m/s]; 0 <= y <= H [m], t >= 0 [s].
  [[nodiscard]] virtual double velocity(double y, double t) const = 0;

  /// Signed velocity gradient du/dy (y, t) [1/s].
  [[nodiscard]] virtual double gradient(double y, double t) const = 0;

  /// Largest velocity of the steady state [m/s]: the scale of every relative error norm.
  [[nodiscard]] virtual double steady_maximum() const = 0;

  /// Bound on |error of velocity| / steady_maximum() that this solution claims for itself.
  [[nodiscard]] virtual double stated_error() const = 0;

  /// One line for reports: what it is and where it comes from.
  [[nodiscard]] virtual std::string description() const = 0;
};

}  // namespace reference
