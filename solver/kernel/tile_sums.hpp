#pragma once

#include "solver/kernel/cell_field.hpp"

namespace mpm::MPM_ISA {

/// Cells whose sums are kept before nodes add them up: they stay in the first or second cache.
constexpr int tile = 256;

/// Beside a tile's cells: whole vectors, at least as many numbers as the degree of the basis.
constexpr int margin = 8;

/// What the particles of a tile give to the nodes of their own cells. Written cell by cell, read node by
/// node: no two particles ever add to the same number at the same time.
template <class Basis, class Sums>
class TileSums {
 public:
  static constexpr int fields = Sums::fields;

  /// Stores the sums of a block that begins `cell` cells into the tile.
  void put(const Basis& basis, int cell, const Sums& sums) {
    unroll<fields>([&](int f) {
      unroll<Basis::nodes>([&](int i) { store(&sums_[f][i][margin + cell], sums.at(basis, f, i)); });
    });
  }

  /// Adds the sums of the first `cells` cells to the nodes, `first` being the first cell's first.
  void add_to(const std::array<double*, Sums::fields>& nodes, const Basis& basis, int first, int cells) {
    constexpr int along = Basis::support[0], across = Basis::support[1];
    for (auto& field : sums_)
      for (auto& of_node : field)
        for (int n = 0; n < margin; ++n) of_node[n] = of_node[margin + cells + n] = 0;
    for (int f = 0; f < fields; ++f)
      for (int l = 0; l < across; ++l) {
        double* row = nodes[f] + first + l * basis.stride;
        for (int n = 0; n < cells + Basis::degree; n += width) {
          Lanes sum = load(row + n);
          unroll<along>([&](int k) { sum += load(&sums_[f][l * along + k][margin + n - k]); });
          store(row + n, sum);
        }
      }
  }

 private:
  alignas(64) double sums_[fields][Basis::nodes][margin + tile + margin];
};

}  // namespace mpm::MPM_ISA
