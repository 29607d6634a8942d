#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace mpm {

/// One direction of the background grid, `cells` cells of size h, with the B-splines of a given polynomial
/// degree on it. A periodic direction has as many functions as cells; between walls there are cells + degree:
/// the knot vector is open, so that the first and the last function alone differ from zero on a wall and
/// interpolate the value there (de Boor, A Practical Guide to Splines, ch. IX).
class Axis {
 public:
  Axis(double length, int cells, bool periodic, int degree);

  /// Number of functions.
  [[nodiscard]] int count() const { return count_; }
  /// Number of the k-th function counted along the axis, 0 <= k < cells + degree: periodic images share one.
  /// Functions k = c to c + degree are those that do not vanish in cell c.
  [[nodiscard]] int function(int k) const { return function_[static_cast<std::size_t>(k)]; }
  /// Greville abscissa of the k-th function counted along the axis [m]: control values taken there from a
  /// linear field reproduce it. Images of a periodic function keep their own, outside [0, length] at its
  /// ends.
  [[nodiscard]] double control_point(int k) const { return control_point_[static_cast<std::size_t>(k)]; }
  /// The control point of a cell's k-th function in cells from where the cell begins. The same to the bit in
  /// all cells far from a wall: knots are whole numbers of cells, so a mean of `degree` of them is a multiple
  /// of 1/degree.
  [[nodiscard]] double control_place(int cell, int k) const {
    return std::round((control_point(cell + k) * inverse_h - cell) * degree) / degree;
  }
  /// Polynomials of the degree + 1 functions in a cell: the coefficient of s^m of the k-th stands at
  /// m * (degree + 1) + k, with s in [0, 1] across the cell.
  [[nodiscard]] const double* polynomials(int cell) const {
    return coefficients_.data() + piece_[static_cast<std::size_t>(cell)];
  }

  /// Integral of every function over the axis [m].
  [[nodiscard]] std::vector<double> integrals() const;

  /// The cell that holds coordinate x; a point on the far end belongs to the last cell.
  [[nodiscard]] int cell_of(double x) const {
    return std::clamp(static_cast<int>(x * inverse_h), 0, cells - 1);
  }

  /// Cell corners along the axis, each once.
  [[nodiscard]] int corners() const { return periodic ? cells : cells + 1; }
  [[nodiscard]] double corner(int i) const { return i == cells ? length : i * h; }

  /// Brings a coordinate back into a periodic direction; false when it lies outside or is not finite.
  bool contain(double& x) const {
    if (x >= 0 && x <= length) return true;
    if (!periodic || !std::isfinite(x)) return false;
    x -= length * std::floor(x / length);
    return x >= 0 && x <= length;
  }

  double length, h, inverse_h;
  int cells, degree;
  bool periodic;

 private:
  std::vector<int> function_;
  std::vector<double> control_point_;
  std::vector<double> coefficients_;  // cells far from a wall share one set
  std::vector<std::size_t> piece_;    // where a cell's set starts
  int count_;
};

}  // namespace mpm
