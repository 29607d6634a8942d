#pragma once

#include "solver/linear_algebra.hpp"

namespace mpm {

/// Numbers as they were last: whoever keeps a result of them asks whether it still stands.
class Remembered {
 public:
  /// Whether number(0), ..., number(count - 1) are to the bit those of the last call; keeps them.
  template <class Number>
  bool same(std::size_t count, const Number& number) {
    bool same = last_.size() == count;
    last_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double now = number(i);
      same &= now == last_[i];
      last_[i] = now;
    }
    return same;
  }

 private:
  ScalarField last_;
};

}  // namespace mpm
