#pragma once

#include "solver/incompressible/lanes/function_matrix.hpp"

namespace mpm::MPM_ISA {

/// sum_p V_p N_ip N_jp over the particles of `width` neighbouring cells, of nx x ny functions each: sums of
/// products of two functions along x times two along y, each pair of functions of an axis once.
template <int nx, int ny>
class CellSums {
 public:
  static constexpr int pairs_x = nx * (nx + 1) / 2, pairs_y = ny * (ny + 1) / 2;

  [[gnu::always_inline]] void add(Lanes volume, const Lanes (&x)[nx], const Lanes (&y)[ny]) {
    Lanes along[pairs_x], across[pairs_y];
    each_pair<nx>([&](int k, int n, int pair) { along[pair] = x[k] * x[n]; });
    each_pair<ny>([&](int l, int m, int pair) { across[pair] = volume * y[l] * y[m]; });
    for (int q = 0; q < pairs_y; ++q)
      unroll<pairs_x>([&](int p) { sum_[q * pairs_x + p] += across[q] * along[p]; });
  }
  [[nodiscard]] Lanes of(int pair_x, int pair_y) const { return sum_[pair_y * pairs_x + pair_x]; }

 private:
  template <int n, class F>
  [[gnu::always_inline]] static void each_pair(F&& f) {
    unroll<n>([&](int a) {
      for (int b = a; b < n; ++b) f(a, b, pair_of(n, a, b));
    });
  }
  Lanes sum_[pairs_x * pairs_y] = {};
};

/// FunctionMatrix for nx x ny functions a cell: what depends on them in its loops.
template <int nx, int ny>
class StencilRows final : public FunctionMatrix {
 public:
  explicit StencilRows(const FunctionRows& rows) : FunctionMatrix(rows, nx, ny) {}

  /// Adds the sums of cells of which the first one begins with function (i, j).
  [[gnu::always_inline]] void add(int i, int j, const CellSums<nx, ny>& sums) {
    double* const begin = row(j) + i;
    for (const Share& share : shares())
      store(begin + share.at, load(begin + share.at) + sums.of(share.pair_x, share.pair_y));
  }

  [[gnu::flatten]] void multiply(const double* x, double* product) const override {
    const int stride = rows().stride();
    const std::ptrdiff_t *const to_ahead = ahead(), *const to_behind = behind();
    for (int j = 0; j < rows().count(1); ++j)
      for (int i = 0; i < rows().count(0); i += width) {
        const double* const entry = row(j) + i;
        const double* const x_i = x + j * stride + i;
        Lanes sum_ahead = load(entry) * load(x_i), sum_behind = 0;
        unroll<offsets(nx, ny) - 1>([&](int before) {
          const int d = before + 1;
          sum_ahead += load(entry + d * stride) * load(x_i + to_ahead[d]);
          sum_behind += load(entry + to_behind[d]) * load(x_i - to_ahead[d]);
        });
        store(product + j * stride + i, sum_ahead + sum_behind);
      }
  }
};

}  // namespace mpm::MPM_ISA
