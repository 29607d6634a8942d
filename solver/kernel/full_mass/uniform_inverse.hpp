#pragma once

#include <vector>

#include "solver/kernel/full_mass/bands.hpp"
#include "solver/kernel/full_mass/full_mass_kernel.hpp"

namespace mpm::MPM_ISA {

/// What conjugate gradients for a mass matrix are preconditioned with: next to the inverse of a uniform
/// fluid's, a tensor product of one matrix an axis (solver/grid/matrices/tensor_mass.hpp), scaled to the true
/// diagonal. The matrices are LineMass::inverse: a sum over a few neighbours needs none of its results
/// before.
class UniformInverse {
 public:
  UniformInverse(const Lattice& lattice, const std::array<LineMass, 2>& mass)
      : lattice_(lattice),
        reach_(mass[0].reach),
        room_(Lattice::whole_vectors(reach_)),
        taps_(2 * reach_ + 1),
        along_(lattice) {
    const int count = lattice.count(0), rows = lattice.count(1), vectors = (count + width - 1) / width;
    taps_along_.assign(static_cast<std::size_t>(vectors * taps_), 0);
    for (int i = 0; i < count; ++i)
      for (int d = 0; d < taps_; ++d)
        taps_along_[static_cast<std::size_t>(i / width * taps_ + d)][i % width] =
            mass[0].inverse[static_cast<std::size_t>(d * count + i)];
    for (int row = 0; row < rows; ++row) {
      first_term_.push_back(static_cast<int>(terms_.size()));
      for (int d = -mass[1].reach; d <= mass[1].reach; ++d)
        if (lattice.periodic(1) || (row + d >= 0 && row + d < rows))
          terms_.push_back({mass[1].inverse[static_cast<std::size_t>((d + mass[1].reach) * rows + row)],
                            ((row + d + rows) % rows - row) * lattice.stride()});
    }
    first_term_.push_back(static_cast<int>(terms_.size()));
  }

  /// The sums along some rows of S r, S the scale of every node.
  void sum_along(Rows rows, const double* scale, const LatticeVector& r) {
    const int count = lattice_.count(0);
    const auto length = static_cast<std::size_t>(count + 2 * room_ + 2 * width);
    // With images around them. All rows before any sum: one that is read across vectors just written waits.
    thread_local LargeArray<double> padded;
    padded.resize(2 * static_cast<std::size_t>(rows.end - rows.begin) * length);
    double* middle = padded.data() + room_;
    for (int row = rows.begin; row < rows.end; ++row)
      for (std::size_t c : {0, 1}) {
        const int first = row * lattice_.stride();
        for (int i = 0; i < count; i += width)
          store(middle + i, load(scale + first + i) * load(r[c] + first + i));
        // Taps that are zero read a little more than the images, and of short rows the images do, too. No
        // other simulation may have left that there: 0 times NaN is NaN.
        store(middle - width, 0);
        store(middle + count + room_, 0);
        // Whole vectors, of which what is within reach is read.
        for (int k = 0; k < room_; k += width) {
          store(middle - room_ + k, lattice_.periodic(0) ? load(middle + count - room_ + k) : 0);
          store(middle + count + k, lattice_.periodic(0) ? load(middle + k) : 0);
        }
        middle += length;
      }
    const double* begin[2];
    for (std::size_t c : {0, 1}) begin[c] = padded.data() + c * length + room_ - reach_;
    for (int row = rows.begin; row < rows.end; ++row) {
      const Lanes* tap = taps_along_.data();
      for (int i = 0; i < count; i += width) {
        Lanes sum[2] = {0, 0};
        for (int d = 0; d < taps_; ++d, ++tap)
          for (std::size_t c : {0, 1}) sum[c] += *tap * load(begin[c] + i + d);
        for (std::size_t c : {0, 1}) store(along_[c] + row * lattice_.stride() + i, sum[c]);
      }
      for (const double*& of_component : begin) of_component += 2 * length;
    }
  }

  /// visit(i, z) with z = S P S r in the vectors of some rows, when the sums along all are done.
  template <class Visit>
  [[gnu::always_inline]] void sum_across(Rows rows, const double* scale, Visit&& visit) const {
    for (int row = rows.begin; row < rows.end; ++row) {
      const Term* const begin = terms_.data() + first_term_[static_cast<std::size_t>(row)];
      const Term* const end = terms_.data() + first_term_[static_cast<std::size_t>(row) + 1];
      lattice_.each_vector({row, row + 1}, [&](int i) {
        Lanes sum[2] = {0, 0};
        for (const Term* term = begin; term != end; ++term)
          for (std::size_t c : {0, 1}) sum[c] += term->tap * load(along_[c] + i + term->away);
        const Lanes s = load(scale + i);
        const Lanes z[2] = {s * sum[0], s * sum[1]};
        visit(i, z);
      });
    }
  }

 private:
  /// Of a sum across the lanes: a row so far away, in the numbering of nodes.
  struct Term {
    double tap;
    int away;
  };

  const Lattice& lattice_;
  int reach_, room_, taps_;        // along a row
  std::vector<Lanes> taps_along_;  // of the nodes of a vector, one vector after another
  std::vector<Term> terms_;        // across, of one row after another
  std::vector<int> first_term_;    // of a row
  LatticeVector along_;
};

}  // namespace mpm::MPM_ISA
