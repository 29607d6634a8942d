#pragma once

#include <algorithm>
#include <vector>

#include "solver/grid/grid.hpp"
#include "solver/particles.hpp"

namespace mpm {

/// A symmetric matrix that couples every node with the (2 degree + 1)^2 nodes about it, stored node by node
/// without indices: entry (dj + degree) * reach + di + degree of a node is its coupling with the node di, dj
/// away. Assembly and products run over contiguous rows.
class StencilMatrix {
 public:
  explicit StencilMatrix(const Grid& grid);

  /// sum_p m_p N_ip N_jp.
  template <class Basis>
  void assemble(const Grid& grid, const Particles& particles) {
    std::fill(entry_.begin(), entry_.end(), 0.0);
    if constexpr (Basis::X::support == Basis::Y::support)  // not a strip, whose matrix is banded
      add_particles<Basis>(grid, particles);
    mirror();
  }

  /// product = A field
  void multiply(const VectorField& field, VectorField& product) const;

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(x_.count * y_.count); }
  [[nodiscard]] double diagonal(std::size_t node) const { return entry_[node * entries() + entries() / 2]; }
  /// visit(row, column, entry) for every stored pair of nodes; a pair may come more than once where a
  /// periodic direction is narrower than the stencil, its entries then add up.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (int j = 0; j < y_.count; ++j)
      for (int i = 0; i < x_.count; ++i)
        for (int dj = -degree_; dj <= degree_; ++dj)
          for (int di = -degree_; di <= degree_; ++di)
            if (const int k = x_.neighbour(i + di), l = y_.neighbour(j + dj); k >= 0 && l >= 0)
              visit(j * x_.count + i, l * x_.count + k,
                    entry_[static_cast<std::size_t>(j * x_.count + i) * entries() +
                           static_cast<std::size_t>((dj + degree_) * reach_ + di + degree_)]);
  }

 private:
  struct Direction {
    int count;
    bool periodic;
    /// Number of the node at a place that may lie outside; -1 beyond a wall.
    [[nodiscard]] int neighbour(int i) const {
      if (periodic) return (i % count + count) % count;
      return i < 0 || i >= count ? -1 : i;
    }
  };

  [[nodiscard]] std::size_t entries() const { return static_cast<std::size_t>(reach_ * reach_); }

  /// Adds to the couplings with dj >= 0.
  template <class Basis>
  void add_particles(const Grid& grid, const Particles& particles) {
    constexpr int degree = Basis::degree, support = degree + 1, reach = 2 * degree + 1;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec2& x_p = particles.position[p];
      const auto wx = Basis::X::at(grid.x, x_p.x());
      const auto wy = Basis::Y::at(grid.y, x_p.y());
      for (int l = 0; l < support; ++l) {
        const int row = grid.y.function(wy.first + l) * grid.x.count();
        for (int k = 0; k < support; ++k) {
          // Of the node's couplings, those with the particle's other nodes begin here.
          double* entry = entry_.data() +
                          static_cast<std::size_t>(row + grid.x.function(wx.first + k)) * (reach * reach) +
                          degree * reach + degree - k;
          const double share = particles.mass[p] * wy.value[l] * wx.value[k];
          for (int m = l; m < support; ++m)
            for (int n = 0; n < support; ++n) entry[(m - l) * reach + n] += share * wy.value[m] * wx.value[n];
        }
      }
    }
  }
  /// Copies the couplings with dj > 0 to their mirror images.
  void mirror();
  template <int degree>
  void multiply_by_degree(VectorField& product) const;

  int degree_, reach_;
  Direction x_, y_;
  std::vector<double> entry_;
  mutable VectorField padded_;  // the field with its images around it; zeros beyond walls
};

}  // namespace mpm
