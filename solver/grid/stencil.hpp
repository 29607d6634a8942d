#pragma once

#include "solver/grid/basis.hpp"
#include "solver/grid/grid.hpp"

namespace mpm {

/// The nodes around one point, with N_i and grad N_i: the tensor product of two one-dimensional bases.
template <class Basis>
class Stencil {
 public:
  static constexpr int support_x = Basis::X::support, support_y = Basis::Y::support;

  Stencil(const Grid& grid, const Vec2& point)
      : grid_(grid),
        point_(point),
        wx_(Basis::X::at(grid.x, point.x())),
        wy_(Basis::Y::at(grid.y, point.y())) {}

  /// visit(node i, N_i)
  template <class Visit>
  void values(Visit&& visit) const {
    visit_nodes([&](std::size_t i, int k, int l) { visit(i, wx_.value[k] * wy_.value[l]); });
  }

  /// visit(node i, grad N_i)
  template <class Visit>
  void gradients(Visit&& visit) const {
    visit_nodes([&](std::size_t i, int k, int l) {
      visit(i, Vec2(wx_.slope[k] * wy_.value[l], wx_.value[k] * wy_.slope[l]));
    });
  }

  /// visit(node i, N_i, x_i - x), x_i the control point; nearest images where the grid is periodic.
  template <class Visit>
  void offsets(Visit&& visit) const {
    visit_nodes([&](std::size_t i, int k, int l) {
      visit(i, wx_.value[k] * wy_.value[l],
            Vec2(Basis::X::offset(grid_.x, wx_.first + k, point_.x()),
                 Basis::Y::offset(grid_.y, wy_.first + l, point_.y())));
    });
  }

  /// visit(node i, N_i, grad N_i)
  template <class Visit>
  void all(Visit&& visit) const {
    visit_nodes([&](std::size_t i, int k, int l) {
      visit(i, wx_.value[k] * wy_.value[l], Vec2(wx_.slope[k] * wy_.value[l], wx_.value[k] * wy_.slope[l]));
    });
  }

 private:
  template <class Visit>
  void visit_nodes(Visit&& visit) const {
    for (int l = 0; l < support_y; ++l) {
      const int row = grid_.y.function(wy_.first + l) * grid_.x.count();
      for (int k = 0; k < support_x; ++k)
        visit(static_cast<std::size_t>(row + grid_.x.function(wx_.first + k)), k, l);
    }
  }

  const Grid& grid_;
  Vec2 point_;
  Weights<support_x> wx_;
  Weights<support_y> wy_;
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
    if constexpr (Basis::X::support == 1)  // nothing varies along x
      sum.col(1) += field[i] * dn.y();
    else
      sum += field[i] * dn.transpose();
  });
  return sum;
}

}  // namespace mpm
