#pragma once

#include <array>

#include "solver/grid/axis.hpp"

namespace mpm {

/// Values and derivatives of the basis functions that do not vanish at one coordinate.
template <int support>
struct Weights {
  int first;                          ///< counted along the axis: Axis::function(first + k) is the k-th
  std::array<double, support> value;  ///< N_k [-]
  std::array<double, support> slope;  ///< dN_k/dx [1/m]
};

/// B-splines of polynomial degree 1 to 3 in both directions: from the table of the cell's polynomials, the
/// same few operations in every cell, at walls as elsewhere.
template <int polynomial_degree>
struct BSpline {
  static constexpr int degree = polynomial_degree;
  static constexpr int support = degree + 1;
  using X = BSpline;  ///< functions along x
  using Y = BSpline;  ///< functions along y

  static Weights<support> at(const Axis& axis, double x) {
    const int cell = axis.cell_of(x);
    const double s = x * axis.inverse_h - cell;
    Weights<support> w;
    w.first = cell;
    if constexpr (degree == 1) {  // hat functions: the bilinear 4-node element of the paper (after Eq. 10)
      w.value = {1 - s, s};
      w.slope = {-axis.inverse_h, axis.inverse_h};
    } else {
      const double* c = axis.polynomials(cell);
      for (int k = 0; k < support; ++k) {
        double value = c[degree * support + k], slope = 0;
        for (int m = degree - 1; m >= 0; --m) {
          slope = slope * s + value;
          value = value * s + c[m * support + k];
        }
        w.value[k] = value;
        w.slope[k] = slope * axis.inverse_h;
      }
    }
    return w;
  }

  /// Control point of the k-th function along the axis, seen from x [m].
  static double offset(const Axis& axis, int k, double x) { return axis.control_point(k) - x; }
};

/// The one function of a direction in which nothing varies: constant.
struct Constant {
  static constexpr int support = 1;
  static Weights<1> at(const Axis&, double) { return {0, {1}, {0}}; }
  static double offset(const Axis&, int, double) { return 0; }
};

/// For scenes that do not vary along x, one periodic cell wide: all images of a B-spline along x share one
/// nodal value, and sum to one. A quarter to a half of the work of BSpline there, the same answer.
template <int polynomial_degree>
struct StripBSpline {
  static constexpr int degree = polynomial_degree;
  using X = Constant;
  using Y = BSpline<degree>;
};

using LinearBasis = BSpline<1>;
using QuadraticBasis = BSpline<2>;
using CubicBasis = BSpline<3>;

}  // namespace mpm
