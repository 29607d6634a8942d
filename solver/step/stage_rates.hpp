#pragma once

#include "solver/linear_algebra.hpp"

namespace mpm {

/// Accelerations that the last two stages of an implicit rule ended with; the next one is guessed from them,
/// so that Newton's method begins at an error of third order in the step.
class StageRates {
 public:
  /// velocity <- start + dt a, with the acceleration of a line through the last two, `beyond` times their
  /// distance in time after the last. Leaves the velocity alone before there are two.
  void guess(const VectorField& start, double dt, double beyond, VectorField& velocity) const {
    if (before_.empty()) return;
    for (std::size_t i = 0; i < start.size(); ++i)
      velocity[i] = start[i] + dt * (last_[i] + beyond * (last_[i] - before_[i]));
  }

  /// A stage has led from `start` to the velocity.
  void keep(const VectorField& start, double dt, const VectorField& velocity) {
    before_.swap(last_);
    last_.resize(start.size());
    for (std::size_t i = 0; i < start.size(); ++i) last_[i] = (velocity[i] - start[i]) / dt;
  }

 private:
  VectorField before_, last_;  // [m/s2]
};

}  // namespace mpm
