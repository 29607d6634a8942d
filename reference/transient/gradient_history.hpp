#pragma once

#include <vector>

#include "reference/transient/spectral_line.hpp"

namespace reference {

/// The gradient w(s, t) on a SpectralLine, known with its time derivative at a sequence of times, and in
/// between by Hermite interpolation through four of them (degree 7 in time).
class GradientHistory {
 public:
  explicit GradientHistory(const SpectralLine& line) : line_(line) {}

  struct Snapshot {
    double time;
    std::vector<double> w, rate;  // nodal values of w [1/s] and dw/dt [1/s2]
  };

  /// Appends the state at a later time than all before.
  void append(const Snapshot& snapshot);

  [[nodiscard]] bool empty() const { return snapshots_.empty(); }
  [[nodiscard]] double first_time() const { return snapshots_.front().time; }
  [[nodiscard]] double last_time() const { return snapshots_.back().time; }
  [[nodiscard]] const std::vector<Snapshot>& snapshots() const { return snapshots_; }
  [[nodiscard]] const SpectralLine& line() const { return line_; }

  /// Nodal w of element `e` at time t, degree + 1 values.
  [[nodiscard]] std::vector<double> element(int e, double t) const;
  /// Integral of w from s = 0 to s at time t.
  [[nodiscard]] double integral(double s, double t) const;

 private:
  struct Blend {
    std::size_t first;                // of up to four neighbouring snapshots
    std::vector<double> value, rate;  // their weights
  };
  [[nodiscard]] Blend blend(double t) const;

  SpectralLine line_;
  std::vector<Snapshot> snapshots_;
  std::vector<std::vector<double>> edge_,
      edge_rate_;  // integrals up to every element's left edge, and their rates
};

}  // namespace reference
