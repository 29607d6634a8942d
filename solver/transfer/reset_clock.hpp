#pragma once

#include "solver/scene/scheme.hpp"

namespace mpm {

/// When particles return to their lattice: counts the steps, and the strain where the fluid is strained
/// fastest, since they last did.
class ResetClock {
 public:
  explicit ResetClock(const Scheme& scheme) : every_(scheme.reset_every), most_strain_(scheme.reset_strain) {}

  /// Whether they are due for it, after a step of dt [s] at whose end the fluid is strained at a rate of
  /// strain_rate() where that is largest [1/s].
  template <class StrainRate>
  [[nodiscard]] bool due(double dt, const StrainRate& strain_rate) {
    ++steps_;
    if (most_strain_ > 0) strain_ += dt * strain_rate();
    return (every_ > 0 && steps_ >= every_) || (most_strain_ > 0 && strain_ >= most_strain_);
  }
  void restart() {
    steps_ = 0;
    strain_ = 0;
  }

 private:
  long every_;          // steps; 0: not by steps
  double most_strain_;  // 0: not by strain
  long steps_ = 0;
  double strain_ = 0;
};

}  // namespace mpm
