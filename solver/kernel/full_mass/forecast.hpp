#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "solver/kernel/full_mass/bands.hpp"

namespace mpm::MPM_ISA {

/// Where a solve begins: the cubic in time through the last four solutions, or their differences to something
/// that is known already, read at the time of the next one.
/// In Taylor-Green vortices it is 30 times closer than a straight line; one of higher degree is no closer
/// once particles have begun to cross cells.
class Forecast {
 public:
  explicit Forecast(const Lattice& lattice)
      : known_{{{0, LatticeVector(lattice)},
                {0, LatticeVector(lattice)},
                {0, LatticeVector(lattice)},
                {0, LatticeVector(lattice)}}} {}

  /// x <- base + a part of what the difference will be at a time [s] later than those known, whatever the
  /// steps between them; base alone as long as none is known.
  void read(const Bands& bands, double time, const LatticeVector& base, LatticeVector& x, double part) const {
    std::array<double, most> weight{};  // Lagrange's
    for (std::size_t k = 0; k < count_; ++k) {
      weight[k] = part;
      for (std::size_t other = 0; other < count_; ++other)
        if (other != k) weight[k] *= (time - known_[other].time) / (known_[k].time - known_[other].time);
    }
    bands.each_vector([&](int i) {
      for (std::size_t c : {0, 1}) {
        Lanes sum = load(base[c] + i);
        for (std::size_t k = 0; k < most; ++k) sum += weight[k] * load(known_[k].difference[c] + i);
        store(x[c] + i, sum);
      }
    });
  }

  /// Of the solution x at a time [s]: takes the place of the oldest.
  void keep(const Bands& bands, double time, const LatticeVector& base, const LatticeVector& x) {
    std::rotate(known_.begin(), known_.end() - 1, known_.end());
    count_ = std::min(count_ + 1, most);
    known_.front().time = time;
    LatticeVector& difference = known_.front().difference;
    bands.each_vector([&](int i) {
      for (std::size_t c : {0, 1}) store(difference[c] + i, load(x[c] + i) - load(base[c] + i));
    });
  }

 private:
  static constexpr std::size_t most = 4;

  struct Known {
    double time;
    LatticeVector difference;
  };
  std::array<Known, most> known_;  // the last one first, zero where there is none
  std::size_t count_ = 0;
};

}  // namespace mpm::MPM_ISA
