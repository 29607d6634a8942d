#pragma once

#include <array>
#include <vector>

#include "solver/incompressible/lanes/function_rows.hpp"

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

  /// Number of a pair of n functions.
  template <int n>
  static constexpr int pair(int a, int b) {
    return a <= b ? a * n - a * (a - 1) / 2 + b - a : pair<n>(b, a);
  }

 private:
  template <int n, class F>
  [[gnu::always_inline]] static void each_pair(F&& f) {
    unroll<n>([&](int a) {
      for (int b = a; b < n; ++b) f(a, b, pair<n>(a, b));
    });
  }
  Lanes sum_[pairs_x * pairs_y] = {};
};

/// Symmetric matrix that couples every function of a component with those that share a cell with it, of
/// nx x ny in each: for every function its couplings with itself and those ahead in the numbering of
/// functions; what couples it with those behind is theirs. Row by row of functions, in each offset by offset.
template <int nx, int ny>
class StencilRows {
 public:
  static constexpr int offsets = nx + (ny - 1) * (2 * nx - 1);

  explicit StencilRows(const FunctionRows& rows) : rows_(rows), entries_(rows, offsets) {
    for (int dy = 0; dy < ny; ++dy)
      for (int dx = dy == 0 ? 0 : 1 - nx; dx < nx; ++dx) {
        const int d = number(dx, dy), pitch = rows.stride();
        ahead_[static_cast<std::size_t>(d)] = dy * pitch + dx;
        behind_[static_cast<std::size_t>(d)] = (d - dy * offsets) * pitch - dx;
      }
    // Neighbouring functions along x add to overlapping vectors: as late as possible after each other.
    for (int k = 0; k < nx; ++k)
      for (int l = 0; l < ny; ++l)
        for (int m = l; m < ny; ++m)
          for (int n = m == l ? k : 0; n < nx; ++n)
            shares_.push_back({(l * offsets + number(n - k, m - l)) * rows.stride() + k,
                               CellSums<nx, ny>::template pair<nx>(k, n),
                               CellSums<nx, ny>::template pair<ny>(l, m)});
  }

  /// The mass of a uniform fluid times a factor: the product of the lines' masses (LineOfFunctions::mass).
  void set_uniform(const double* mass_x, const double* mass_y, double factor) {
    for (int dy = 0; dy < ny; ++dy)
      for (int dx = dy == 0 ? 0 : 1 - nx; dx < nx; ++dx)
        for (int j = 0; j + dy < rows_.count(1); ++j)
          for (int i = std::max(0, -dx); i < rows_.count(0) - std::max(0, dx); ++i)
            row(j)[number(dx, dy) * rows_.stride() + i] =
                factor * mass_y[dy * rows_.count(1) + j] *
                (dx < 0 ? mass_x[-dx * rows_.count(0) + i + dx] : mass_x[dx * rows_.count(0) + i]);
  }
  void copy(const StencilRows& other) { entries_.copy(other.entries_); }

  /// Adds the sums of cells of which the first one begins with function (i, j).
  [[gnu::always_inline]] void add(int i, int j, const CellSums<nx, ny>& sums) {
    double* const begin = row(j) + i;
    for (const Share& share : shares_)
      store(begin + share.at, load(begin + share.at) + sums.of(share.pair_x, share.pair_y));
  }

  /// product = A x, x with its margins zero.
  void multiply(const double* x, double* product) const {
    const int stride = rows_.stride();
    for (int j = 0; j < rows_.count(1); ++j)
      for (int i = 0; i < rows_.count(0); i += width) {
        const double* const entry = entries_.data() + j * offsets * stride + i;
        const double* const x_i = x + j * stride + i;
        Lanes ahead = load(entry) * load(x_i), behind = 0;
        unroll<offsets - 1>([&](int before) {
          const auto d = static_cast<std::size_t>(before + 1);
          ahead += load(entry + (before + 1) * stride) * load(x_i + ahead_[d]);
          behind += load(entry + behind_[d]) * load(x_i - ahead_[d]);
        });
        store(product + j * stride + i, ahead + behind);
      }
  }

 private:
  /// Of an offset ahead; zero for a function itself.
  static constexpr int number(int dx, int dy) {
    return dy == 0 ? dx : nx + (dy - 1) * (2 * nx - 1) + dx + nx - 1;
  }
  double* row(int j) { return entries_.data() + j * offsets * rows_.stride(); }

  struct Share {
    int at, pair_x, pair_y;
  };

  const FunctionRows& rows_;
  FunctionArray entries_;
  std::array<std::ptrdiff_t, offsets> ahead_,
      behind_;  // from a function to its partner; to its partner's entry
  std::vector<Share> shares_;
};

}  // namespace mpm::MPM_ISA
