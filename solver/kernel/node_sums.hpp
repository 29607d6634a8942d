#pragma once

#include "solver/kernel/cell_sums.hpp"

namespace mpm::MPM_ISA {

/// Lanes moved up by one; the last lane of `before` comes in at the bottom.
inline Lanes moved_up(Lanes before, Lanes x) {
  return [&]<int... lane>(std::integer_sequence<int, lane...>) {
    return Lanes(__builtin_shufflevector(before.v, x.v, (width - 1 + lane)...));
  }
  (std::make_integer_sequence<int, width>{});
}

/// Adds what the particles of one block after another give to the nodes of their cells. Lane c of the k-th
/// node along a row is node c + k of that row: instead of adding lanes to memory one by one, sums move up
/// across the lanes, the last ones into the next block. Row by row with r_k the sums of the k-th node,
///     r_0 + up(r_1 + up(r_2 + up(r_3))).
template <class Basis, class Sums>
class NodeSums {
 public:
  NodeSums(const Basis& basis, const std::array<double*, Sums::fields>& nodes)
      : basis_(basis), nodes_(nodes) {}

  void add(int first_node, const Sums& sums) {
    add_sums(first_node, [&](int field) -> decltype(auto) { return sums.at_nodes(basis_, field); });
  }

  /// After the last block, if there was one: what moves up from it.
  void finish() {
    if (next_ < 0) return;
    for (int moved = 0; moved < Basis::degree; moved += width)
      add_sums(next_, [](int) { return std::array<Lanes, Basis::nodes>{}; });
  }

 private:
  static constexpr int columns = Basis::support[0], rows = Basis::support[1];

  template <class AtNodes>
  [[gnu::always_inline]] void add_sums(int first_node, AtNodes&& at_nodes) {
    next_ = first_node + width;
    unroll<Sums::fields>([&](int f) {
      const auto& at = at_nodes(f);
      unroll<rows>([&](int l) {
        Lanes sum = at[l * columns + columns - 1];
        unroll<columns - 1>([&](int step) {
          Lanes& before = before_[f][l][step];
          const Lanes up = moved_up(before, sum);
          before = sum;
          sum = at[l * columns + columns - 2 - step] + up;
        });
        double* const node = nodes_[static_cast<std::size_t>(f)] + first_node + l * basis_.stride;
        store(node, load(node) + sum);
      });
    });
  }

  // A copy: for all that a compiler knows, stores to nodes might change what lies elsewhere.
  const Basis basis_;
  std::array<double*, Sums::fields> nodes_;
  int next_ = -1;                                         ///< first node of the next block
  Lanes before_[Sums::fields][rows][Basis::degree] = {};  ///< of the block before
};

}  // namespace mpm::MPM_ISA
