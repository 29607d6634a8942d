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

/// The consistent mass matrix on a lattice. Entry d of node i is its coupling with the node d away: of the
/// (2 degree + 1)^2 those ahead in the numbering of nodes, and itself. Those behind are what the nodes there
/// have.
template <int degree>
class MassMatrix {
 public:
  explicit MassMatrix(const Lattice& lattice) : lattice_(lattice), entries_(lattice) {
    for (int dj = 0; dj <= degree; ++dj)
      for (int di = dj == 0 ? 0 : -degree; di <= degree; ++di)
        distance_[number(di, dj)] = dj * lattice.stride() + di;
    // Neighbouring functions along the lanes add to overlapping vectors: they come as late as possible after
    // each other.
    for (int k = 0; k < support; ++k)
      for (int l = 0; l < support; ++l)
        for (int m = l; m < support; ++m)
          for (int n = m == l ? k : 0; n < support; ++n)
            shares_.push_back(
                {static_cast<std::ptrdiff_t>(number(n - k, m - l) * entries_.pitch()) + l * lattice.stride() +
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
      for (int row = 0; row < lattice_.count(1); ++row) lattice_.fill_margin(entries, row);
    });
  }

  /// M_ii of all nodes.
  [[nodiscard]] const double* diagonal() const { return entries_[0]; }

  /// (M x)_i of both components in the vector of nodes at i; x with its margin set.
  [[gnu::always_inline]] void row(int i, const double* const x[2], Lanes (&product)[2]) const {
    const double* const entry = entries_[0] + i;
    const double *const x_0 = x[0] + i, *const x_1 = x[1] + i;
    const std::size_t pitch = entries_.pitch();
    const Lanes own = load(entry);
    Lanes ahead[2] = {own * load(x_0), own * load(x_1)}, behind[2] = {0, 0};
    unroll<static_cast<int>(distances) - 1>([&](int before) {
      const int d = before + 1;
      const std::ptrdiff_t away = distance_[d];
      const double* const of_d = entry + static_cast<std::size_t>(d) * pitch;
      const Lanes a = load(of_d), b = load(of_d - away);
      ahead[0] += a * load(x_0 + away);
      ahead[1] += a * load(x_1 + away);
      behind[0] += b * load(x_0 - away);
      behind[1] += b * load(x_1 - away);
    });
    for (int c : {0, 1}) product[c] = ahead[c] + behind[c];
  }

 private:
  static constexpr int support = degree + 1, reach = 2 * degree + 1;
  static constexpr std::size_t distances = static_cast<std::size_t>(reach * reach / 2 + 1);

  /// Zero for a node itself.
  static std::size_t number(int di, int dj) {
    return static_cast<std::size_t>(dj == 0 ? di : degree + 1 + (dj - 1) * reach + di + degree);
  }

  /// From where a block begins to the entries to which it adds one of its sums.
  struct Share {
    std::ptrdiff_t at;
    int sum;
  };

  const Lattice& lattice_;
  LatticeFields<distances> entries_;
  std::ptrdiff_t distance_[distances];
  std::vector<Share> shares_;
};

}  // namespace mpm::MPM_ISA
