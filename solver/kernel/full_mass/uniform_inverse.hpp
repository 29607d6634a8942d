#pragma once

#include <vector>

#include "solver/kernel/full_mass/bands.hpp"
#include "solver/kernel/full_mass/full_mass_kernel.hpp"

namespace mpm::MPM_ISA {

/// What conjugate gradients for a mass matrix are preconditioned with: next to the inverse of a uniform
/// fluid's, a tensor product of one matrix an axis (solver/grid/tensor_mass.hpp), scaled to the true
/// diagonal. The matrices are LineMass::inverse: a sum over a few neighbours needs none of its results
/// before.
class UniformInverse {
 public:
  UniformInverse(const Lattice& lattice, const std::array<LineMass, 2>& mass)
      : lattice_(lattice), reach_{mass[0].reach, mass[1].reach}, along_(lattice) {
    const int count = mass[0].count, vectors = (count + width - 1) / width;
    taps_along_.assign(static_cast<std::size_t>(vectors * (2 * reach_[0] + 1)), 0);
    for (int i = 0; i < count; ++i)
      for (int d = 0; d <= 2 * reach_[0]; ++d)
        taps_along_[static_cast<std::size_t>(i / width * (2 * reach_[0] + 1) + d)][i % width] =
            mass[0].inverse[static_cast<std::size_t>(d * count + i)];
    taps_across_ = mass[1].inverse;
  }

  /// The sum along a row of S r, S the scale of every node.
  void sum_along(int row, const double* scale, const LatticeVector& r) {
    const int count = lattice_.count(0), reach = reach_[0], first = row * lattice_.stride();
    // With images around it; as long as the longest row and reach.
    thread_local std::vector<double> padded[2];
    for (std::size_t c : {0, 1}) {
      padded[c].resize(static_cast<std::size_t>(count + 2 * reach + 2 * width));
      double* const middle = padded[c].data() + reach;
      for (int i = 0; i < count; i += width)
        store(middle + i, load(scale + first + i) * load(r[c] + first + i));
      for (int d = 1; d <= reach; ++d) {
        middle[-d] = lattice_.periodic(0) ? middle[(count - d % count) % count] : 0;
        middle[count - 1 + d] = lattice_.periodic(0) ? middle[(d - 1) % count] : 0;
      }
    }
    const Lanes* tap = taps_along_.data();
    for (int i = 0; i < count; i += width) {
      Lanes sum[2] = {0, 0};
      for (int d = 0; d <= 2 * reach; ++d, ++tap)
        for (std::size_t c : {0, 1}) sum[c] += *tap * load(padded[c].data() + i + d);
      for (std::size_t c : {0, 1}) store(along_[c] + first + i, sum[c]);
    }
  }

  /// visit(i, z) with z = S P S r in the vectors of a row of nodes, when the sums along all rows are done.
  template <class Visit>
  [[gnu::always_inline]] void sum_across(int row, const double* scale, Visit&& visit) const {
    const int count = lattice_.count(1), reach = reach_[1];
    Term terms[2 * most_reach + 1];
    int used = 0;
    for (int d = -reach; d <= reach; ++d)
      if (lattice_.periodic(1) || (row + d >= 0 && row + d < count))
        terms[used++] = {taps_across_[static_cast<std::size_t>((d + reach) * count + row)],
                         ((row + d + count) % count - row) * lattice_.stride()};
    lattice_.each_vector(row, [&](int i) {
      Lanes sum[2] = {0, 0};
      for (int k = 0; k < used; ++k)
        for (std::size_t c : {0, 1}) sum[c] += terms[k].tap * load(along_[c] + i + terms[k].away);
      const Lanes s = load(scale + i);
      const Lanes z[2] = {s * sum[0], s * sum[1]};
      visit(i, z);
    });
  }

 private:
  /// Of a sum across the lanes: a row so far away, in the numbering of nodes.
  struct Term {
    double tap;
    int away;
  };

  const Lattice& lattice_;
  int reach_[2];
  std::vector<Lanes> taps_along_;  // of the nodes of a vector, one vector after another
  std::vector<double> taps_across_;
  LatticeVector along_;
};

}  // namespace mpm::MPM_ISA
