#pragma once

#include "solver/kernel/cell_weights.hpp"
#include "solver/kernel/thread_team.hpp"

namespace mpm::MPM_ISA {

/// Cells whose sums are kept before nodes add them up: they stay in the first or second cache.
constexpr int tile = 256;

/// Beside a tile's cells: whole vectors, at least as many numbers as the degree of the basis.
constexpr int margin = 8;

/// What the particles of a tile give to the nodes of their own cells. Written cell by cell, read node by
/// node: no two particles ever add to the same number at the same time.
template <class Basis, int fields>
class TileSums {
 public:
  /// Stores the sums of a block that begins `cell` cells into the tile.
  void put(int cell, const Lanes (&sum)[fields][Basis::nodes]) {
    for (int f = 0; f < fields; ++f)
      unroll<Basis::nodes>([&](int i) { store(&sums_[f][i][margin + cell], sum[f][i]); });
  }

  /// Adds the sums of the first `cells` cells to the nodes, `first` being the first cell's first.
  void add_to(double* const (&nodes)[fields], const Basis& basis, int first, int cells) {
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

/// Cells [begin, end) that one thread works on at a time. Chunks of even number touch no node in common, nor
/// do those of odd number: first the ones, then the others, in whatever order, give the same sums.
struct Chunks {
  int length, count, cells;

  /// For cells of which each touches nodes up to `reach` further on; sums are added in whole vectors.
  Chunks(int cells, int reach)
      : length((reach + margin + tile) / tile * tile), count((cells + length - 1) / length), cells(cells) {}

  [[nodiscard]] int begin(int chunk) const { return chunk * length; }
  [[nodiscard]] int end(int chunk) const { return std::min(cells, (chunk + 1) * length); }

  /// f(chunk) for all, on all threads.
  template <class F>
  void each(ThreadTeam* team, F&& f) const {
    run(team, 0, 1, count, f);
  }
  /// f(chunk) for those of even number, then for those of odd number.
  template <class F>
  void each_in_two_turns(ThreadTeam* team, F&& f) const {
    run(team, 0, 2, (count + 1) / 2, f);
    run(team, 1, 2, count / 2, f);
  }

 private:
  template <class F>
  struct Loop {
    F& f;
    int first, step;

    /// One share; everything that the loop calls is inlined here, so that a pass is one piece of code.
    [[gnu::flatten]] static void work(void* context, int share) {
      const Loop& loop = *static_cast<Loop*>(context);
      loop.f(loop.first + share * loop.step);
    }
  };
  template <class F>
  static void run(ThreadTeam* team, int first, int step, int shares, F& f) {
    Loop<F> loop{f, first, step};
    team->run(shares, Loop<F>::work, &loop);
  }
};

}  // namespace mpm::MPM_ISA
