#pragma once

#include <Eigen/Core>
#include <vector>

namespace reference {

/// B-splines of one degree on [0, 1], of the highest continuity, clamped at both ends (de Boor, A Practical
/// Guide to Splines, 2001).
class SplineAxis {
 public:
  /// `breaks`: ends of the spans, ascending from 0 to 1. Throws std::invalid_argument for others, or a degree
  /// below 2.
  SplineAxis(std::vector<double> breaks, int degree);

  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] int spans() const { return static_cast<int>(breaks_.size()) - 1; }
  /// Number of functions, spans + degree.
  [[nodiscard]] int size() const { return spans() + degree_; }
  [[nodiscard]] double start(int span) const { return breaks_[static_cast<std::size_t>(span)]; }
  [[nodiscard]] double width(int span) const { return start(span + 1) - start(span); }
  /// Where function i may be interpolated: the mean of its inner knots (Greville).
  [[nodiscard]] double greville(int i) const;

  /// The functions that are not zero at a place: value, slope and curvature in rows 0 to 2, functions
  /// `first` to `first` + degree in columns.
  struct Local {
    int first;
    Eigen::Matrix3Xd of;
  };
  [[nodiscard]] Local at(double x) const;
  /// The same, x belonging to a given span.
  [[nodiscard]] Local at(double x, int span) const;

 private:
  std::vector<double> breaks_, knots_;
  int degree_;
};

/// Ends of `spans` spans, symmetric about 1/2, that grow away from both ends of [0, 1] in proportion to their
/// distance from it: x = (1 + tanh(g (2 s - 1))/tanh(g))/2 at s = i/spans. g = 0: equal spans.
std::vector<double> clustered_breaks(int spans, double g);

}  // namespace reference
