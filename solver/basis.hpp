#pragma once

#include <array>

#include "solver/grid.hpp"

namespace mpm {

/// Values and derivatives of the basis functions that do not vanish at one coordinate.
template <int support>
struct Weights {
  int first;                          ///< counted along the axis: Axis::function(first + k) is the k-th
  std::array<double, support> value;  ///< N_k [-]
  std::array<double, support> slope;  ///< dN_k/dx [1/m]
};

/// Hat functions: in 2D the bilinear 4-node element of the paper (after Eq. 10).
struct LinearBasis {
  static constexpr int degree = 1;
  static constexpr int support = 2;

  static Weights<support> at(const Axis& axis, double x) {
    const int cell = axis.cell_of(x);
    const double s = x * axis.inverse_h - cell;
    return {cell, {1 - s, s}, {-axis.inverse_h, axis.inverse_h}};
  }
};

/// The nodes around one point, with N_i and grad N_i: the tensor product of two one-dimensional bases.
template <class Basis>
class Stencil {
 public:
  Stencil(const Grid& grid, const Vec2& point)
      : grid_(grid), wx_(Basis::at(grid.x, point.x())), wy_(Basis::at(grid.y, point.y())) {}

  /// visit(node i, N_i)
  template <class Visit>
  void values(Visit&& visit) const {
    for (int l = 0; l < Basis::support; ++l) {
      const int row = grid_.y.function(wy_.first + l) * grid_.x.count();
      for (int k = 0; k < Basis::support; ++k)
        visit(static_cast<std::size_t>(row + grid_.x.function(wx_.first + k)), wx_.value[k] * wy_.value[l]);
    }
  }

  /// visit(node i, grad N_i)
  template <class Visit>
  void gradients(Visit&& visit) const {
    for (int l = 0; l < Basis::support; ++l) {
      const int row = grid_.y.function(wy_.first + l) * grid_.x.count();
      for (int k = 0; k < Basis::support; ++k)
        visit(static_cast<std::size_t>(row + grid_.x.function(wx_.first + k)),
              Vec2(wx_.slope[k] * wy_.value[l], wx_.value[k] * wy_.slope[l]));
    }
  }

 private:
  const Grid& grid_;
  Weights<Basis::support> wx_, wy_;
};

/// Value of a nodal field at a point.
template <class Basis>
Vec2 interpolate(const Grid& grid, const VectorField& field, const Vec2& point) {
  Vec2 sum = Vec2::Zero();
  Stencil<Basis>(grid, point).values([&](std::size_t i, double n) { sum += n * field[i]; });
  return sum;
}

/// Gradient L_ab = d v_a / d x_b of a nodal field at a point.
template <class Basis>
Mat2 gradient(const Grid& grid, const VectorField& field, const Vec2& point) {
  Mat2 sum = Mat2::Zero();
  Stencil<Basis>(grid, point).gradients([&](std::size_t i, const Vec2& dn) {
    sum += field[i] * dn.transpose();
  });
  return sum;
}

}  // namespace mpm
