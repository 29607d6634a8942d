#pragma once

#include <vector>

#include "solver/kernel/cell_weights.hpp"
#include "solver/kernel/full_mass/bands.hpp"

namespace mpm::MPM_ISA {

/// sum_p m_p N_ip N_jp over the particles of the cells of a block: sums of products m N_k N_n along times N_l
/// N_m across the lanes, each pair of functions of an axis once.
template <int degree>
class CellMass {
 public:
  static constexpr int support = degree + 1, pairs = support * (support + 1) / 2;

  template <class Weights>
  void add(Lanes m, const Weights& n_p) {
    Lanes along[pairs], across[pairs];
    unroll<support>([&](int k) {
      for (int n = k; n < support; ++n) {
        along[pair(k, n)] = n_p.along.value[k] * n_p.along.value[n];
        across[pair(k, n)] = m * n_p.across.value[k] * n_p.across.value[n];
      }
    });
    for (int q = 0; q < pairs; ++q)
      unroll<pairs>([&](int p) { sum_[q * pairs + p] += across[q] * along[p]; });
  }

  /// Number of a pair of functions.
  static constexpr int pair(int k, int n) {
    return k <= n ? k * support - k * (k - 1) / 2 + n - k : pair(n, k);
  }
  [[nodiscard]] Lanes operator[](int sum) const { return sum_[sum]; }

 private:
  Lanes sum_[pairs * pairs] = {};  // pair across the lanes * pairs + pair along them
};

/// What a solve asks of a matrix on a lattice.
class LatticeMatrix {
 public:
  virtual ~LatticeMatrix() = default;

  /// M_ii of all nodes.
  [[nodiscard]] virtual const double* diagonal() const = 0;
  /// product = M x, both components, in some rows of nodes; x with its margin set.
  virtual void multiply(Rows rows, const LatticeVector& x, LatticeVector& product) const = 0;
};

/// The consistent mass matrix on a lattice. Entry d of node i is its coupling with the node d away: of the
/// (2 degree + 1)^2 those ahead in the numbering of nodes, and itself. Those behind are what the nodes there
/// have.
template <int degree>
class MassMatrix final : public LatticeMatrix {
 public:
  explicit MassMatrix(const Lattice& lattice) : lattice_(lattice), entries_(lattice) {
    // Neighbouring functions along the lanes add to overlapping vectors: they come as late as possible after
    // each other.
    for (int k = 0; k < support; ++k)
      for (int l = 0; l < support; ++l)
        for (int m = l; m < support; ++m)
          for (int n = m == l ? k : 0; n < support; ++n)
            shares_.push_back(
                {number(n - k, m - l) * static_cast<std::ptrdiff_t>(entries_.pitch()) + l * lattice.stride() +
                     k,
                 CellMass<degree>::pair(l, m) * CellMass<degree>::pairs + CellMass<degree>::pair(k, n)});
  }

  void clear(Rows rows) { entries_.clear(lattice_, rows); }
  /// Adds what the cells of a block have, whose first one begins at a node.
  void add(int first_node, const CellMass<degree>& mass) {
    double* const begin = entries_[0] + first_node;
    for (const Share& share : shares_) store(begin + share.at, load(begin + share.at) + mass[share.sum]);
  }
  /// When all have been added.
  void complete(const Bands& bands) {
    bands.each(static_cast<int>(distances), [&](int d) {
      double* const entries = entries_[static_cast<std::size_t>(d)];
      lattice_.join_images(entries);
      lattice_.fill_margins_below(entries, d <= degree ? 0 : (d - degree - 1) / reach + 1);
    });
  }

  [[nodiscard]] const double* diagonal() const override { return entries_[0]; }

  [[gnu::flatten]] void multiply(Rows rows, const LatticeVector& x, LatticeVector& product) const override {
    int row = rows.begin;
    for (; row + at_once <= rows.end; row += at_once) multiply_rows<at_once>(row, x, product);
    for (; row < rows.end; ++row) multiply_rows<1>(row, x, product);
  }

 private:
  static constexpr int support = degree + 1, reach = 2 * degree + 1;
  static constexpr std::size_t distances = static_cast<std::size_t>(reach * reach / 2 + 1);

  /// Rows whose products share what they read of x.
  static constexpr int at_once = 4;

  template <int rows>
  [[gnu::always_inline]] void multiply_rows(int first_row, const LatticeVector& of,
                                            LatticeVector& product) const {
    const double* const x[2] = {of[0], of[1]};
    double* const to[2] = {product[0], product[1]};
    const std::ptrdiff_t stride = lattice_.stride(), pitch = static_cast<std::ptrdiff_t>(entries_.pitch());
    lattice_.each_vector({first_row, first_row + 1}, [&](int i) {
      // Two sums each, of the entries of nodes themselves and of those behind: independent of each other.
      Lanes ahead[rows][2], behind[rows][2];
      for (int row = 0; row < rows; ++row)
        for (int c : {0, 1}) ahead[row][c] = behind[row][c] = 0;
      unroll<rows + 2 * degree>([&](int line) {
        unroll<reach>([&](int column) {
          const int di = column - degree;
          const std::ptrdiff_t at = i + (line - degree) * stride + di;
          const Lanes x_at[2] = {load(x[0] + at), load(x[1] + at)};
          unroll<rows>([&](int row) {
            const int dj = line - degree - row;
            if (dj < -degree || dj > degree) return;
            const bool is_ahead = dj > 0 || (dj == 0 && di >= 0);
            const double* const entry = is_ahead ? entries_[0] + number(di, dj) * pitch + i + row * stride
                                                 : entries_[0] + number(-di, -dj) * pitch + at;
            const Lanes m = load(entry);
            for (int c : {0, 1}) (is_ahead ? ahead : behind)[row][c] += m * x_at[c];
          });
        });
      });
      for (int row = 0; row < rows; ++row)
        for (int c : {0, 1}) store(to[c] + i + row * stride, ahead[row][c] + behind[row][c]);
    });
  }

  /// Zero for a node itself.
  static constexpr std::ptrdiff_t number(int di, int dj) {
    return dj == 0 ? di : degree + 1 + (dj - 1) * reach + di + degree;
  }

  /// From where a block begins to the entries to which it adds one of its sums.
  struct Share {
    std::ptrdiff_t at;
    int sum;
  };

  const Lattice& lattice_;
  LatticeFields<distances> entries_;
  std::vector<Share> shares_;
};

}  // namespace mpm::MPM_ISA
