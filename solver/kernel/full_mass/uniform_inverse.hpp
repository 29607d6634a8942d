#pragma once

#include <vector>

#include "solver/kernel/full_mass/full_mass_kernel.hpp"
#include "solver/kernel/full_mass/lattice.hpp"

namespace mpm::MPM_ISA {

/// What conjugate gradients for a mass matrix are preconditioned with: the inverse of a uniform fluid's, a
/// tensor product of one matrix an axis (solver/grid/tensor_mass.hpp), scaled to the true diagonal. The
/// entries of those fall off by half and more from node to node; a few about the diagonal are an inverse as
/// good for particles in disorder, and a sum over a few neighbours needs none of its results before.
class UniformInverse {
 public:
  UniformInverse(const Lattice& lattice, const std::array<LineMass, 2>& mass)
      : lattice_(lattice), reach_{mass[0].reach, mass[1].reach}, along_(lattice) {
    const int stride = lattice.stride();
    const auto row = static_cast<std::size_t>(stride + width);
    tap_along_.assign(static_cast<std::size_t>(2 * reach_[0] + 1) * row, 0);
    for (int d = 0; d <= 2 * reach_[0]; ++d)
      for (int i = 0; i < mass[0].count; ++i)
        tap_along_[static_cast<std::size_t>(d) * row + static_cast<std::size_t>(i)] =
            mass[0].inverse[static_cast<std::size_t>(d * mass[0].count + i)];
    tap_across_ = mass[1].inverse;
    for (auto& padded : padded_) padded.assign(row + 2 * static_cast<std::size_t>(reach_[0]) + width, 0);
  }

  /// z = S P S r, S the scale of every node.
  void apply(const double* scale, const double* const r[2], double* const z[2]) {
    for (int row = 0; row < lattice_.count(1); ++row) sum_along(row * lattice_.stride(), scale, r);
    for (int row = 0; row < lattice_.count(1); ++row) sum_across(row, scale, z);
  }

 private:
  void sum_along(int first, const double* scale, const double* const r[2]) {
    const int count = lattice_.count(0), reach = reach_[0];
    for (std::size_t c : {0, 1}) {
      double* const middle = padded_[c].data() + reach;
      for (int i = 0; i < count; i += width)
        store(middle + i, load(scale + first + i) * load(r[c] + first + i));
      for (int d = 1; d <= reach; ++d) {
        middle[-d] = lattice_.periodic(0) ? middle[(count - d % count) % count] : 0;
        middle[count - 1 + d] = lattice_.periodic(0) ? middle[(d - 1) % count] : 0;
      }
    }
    const auto row = static_cast<std::size_t>(lattice_.stride() + width);
    for (int i = 0; i < count; i += width) {
      Lanes sum[2] = {0, 0};
      const double* tap = tap_along_.data() + i;
      for (int d = 0; d <= 2 * reach; ++d, tap += row) {
        const Lanes entry = load(tap);
        for (std::size_t c : {0, 1}) sum[c] += entry * load(padded_[c].data() + i + d);
      }
      for (std::size_t c : {0, 1}) store(along_[c] + first + i, sum[c]);
    }
  }

  void sum_across(int row, const double* scale, double* const z[2]) {
    const int count = lattice_.count(1), reach = reach_[1];
    terms_.clear();
    for (int d = -reach; d <= reach; ++d)
      if (lattice_.periodic(1) || (row + d >= 0 && row + d < count))
        terms_.push_back({tap_across_[static_cast<std::size_t>((d + reach) * count + row)],
                          (row + d + count) % count * lattice_.stride()});
    const int first = row * lattice_.stride();
    for (int i = 0; i < lattice_.count(0); i += width) {
      Lanes sum[2] = {0, 0};
      for (const Term& term : terms_)
        for (std::size_t c : {0, 1}) sum[c] += term.entry * load(along_[c] + term.row + i);
      for (std::size_t c : {0, 1}) store(z[c] + first + i, load(scale + first + i) * sum[c]);
    }
  }

  /// Of a sum across the lanes: an entry, and where its row begins.
  struct Term {
    double entry;
    int row;
  };

  const Lattice& lattice_;
  int reach_[2];
  std::vector<double> tap_along_;  // a row with a vector more for each distance
  std::vector<double> tap_across_;
  std::vector<Term> terms_;        // of one row
  std::vector<double> padded_[2];  // a row with images around it
  LatticeVector along_;
};

}  // namespace mpm::MPM_ISA
