#pragma once

#include <algorithm>
#include <vector>

#include "solver/incompressible/lanes/function_rows.hpp"

namespace mpm::MPM_ISA {

/// Four functions at most fill half of the widest registers: the other half would be so much work for
/// nothing.
template <bool is_half>
struct WeightVector {
  using Type = Vector;
};
template <>
struct WeightVector<true> {
  using Type = double __attribute__((vector_size(4 * sizeof(double))));
};

/// n functions of an axis at a point, one a lane, zeros behind the last.
template <int n>
struct FunctionWeights {
  using Part = typename WeightVector<(n <= 4 && width > 4)>::Type;
  static constexpr int lanes = sizeof(Part) / sizeof(double), parts = (n + lanes - 1) / lanes,
                       padded = parts * lanes;

  Part part[parts];
  [[nodiscard]] const double* of() const { return reinterpret_cast<const double*>(part); }

  [[gnu::always_inline]] static Part load_part(const double* from) {
    Part part;
    std::memcpy(&part, from, sizeof part);
    return part;
  }
};

/// The polynomials that the functions of an axis are in each cell, every distinct set once: away from walls
/// all cells have the same.
class PolynomialSets {
 public:
  /// Of n functions a cell, each power's coefficients filled up to `padded` with zeros.
  PolynomialSets(const double* polynomials, int cells, std::size_t n, std::size_t padded) {
    const std::size_t set = padded * n;
    for (int cell = 0; cell < cells; ++cell) {
      const double* const from = polynomials + static_cast<std::size_t>(cell) * n * n;
      std::size_t known = 0;
      const auto same = [&] {
        for (std::size_t m = 0; m < n; ++m)
          if (!std::equal(from + m * n, from + (m + 1) * n, sets_.data() + known * set + m * padded))
            return false;
        return true;
      };
      while (known * set < sets_.size() && !same()) ++known;
      if (known * set == sets_.size()) {
        sets_.resize(sets_.size() + set, 0.0);
        for (std::size_t m = 0; m < n; ++m)
          std::copy_n(from + m * n, n, sets_.data() + known * set + m * padded);
      }
      of_cell_.push_back(static_cast<int>(known * set));
    }
  }

  [[nodiscard]] const double* of_cell(int cell) const {
    return sets_.data() + of_cell_[static_cast<std::size_t>(cell)];
  }

 private:
  std::vector<double> sets_;  // [set][power, the highest first][function]
  std::vector<int> of_cell_;
};

/// The n functions of an axis in each cell.
template <int n>
class CellPolynomials {
 public:
  CellPolynomials(const double* polynomials, int cells)
      : sets_(polynomials, cells, n, FunctionWeights<n>::padded) {}

  /// The functions of a cell at xi in [0, 1], by Horner's rule.
  [[gnu::always_inline]] void at(int cell, double xi, FunctionWeights<n>& sum) const {
    using W = FunctionWeights<n>;
    const double* const powers = sets_.of_cell(cell);
    unroll<W::parts>([&](int p) { sum.part[p] = W::load_part(powers + p * W::lanes); });
    unroll<n - 1>([&](int m) {
      unroll<W::parts>([&](int p) {
        sum.part[p] = sum.part[p] * xi + W::load_part(powers + (m + 1) * W::padded + p * W::lanes);
      });
    });
  }

 private:
  PolynomialSets sets_;
};

/// The polynomials of `width` neighbouring cells at once, a lane each, n x n coefficients a cell.
inline LargeArray<Lanes> polynomials_of_blocks(const double* polynomials, int cells, int n) {
  LargeArray<Lanes> powers;
  for (int first = 0; first < cells; first += width)
    for (int k = 0; k < n * n; ++k) {
      Lanes of_cells = 0;
      for (int lane = 0; lane < std::min(width, cells - first); ++lane)
        of_cells[lane] = polynomials[static_cast<std::ptrdiff_t>(first + lane) * n * n + k];
      powers.push_back(of_cells);
    }
  return powers;
}

/// CellPolynomials for `width` neighbouring cells at once: every function's coefficients.
template <int n>
class BlockPolynomials {
 public:
  BlockPolynomials(const double* polynomials, int cells)
      : powers_(polynomials_of_blocks(polynomials, cells, n)) {}

  [[gnu::always_inline]] void at(int block, Lanes xi, Lanes (&sum)[n]) const {
    const Lanes* const powers = powers_.data() + static_cast<std::ptrdiff_t>(block) * n * n;
    unroll<n>([&](int k) { sum[k] = powers[k]; });
    unroll<n - 1>([&](int m) { unroll<n>([&](int k) { sum[k] = sum[k] * xi + powers[(m + 1) * n + k]; }); });
  }

 private:
  LargeArray<Lanes> powers_;
};

/// The functions of one cell for a lane of points each.
template <int n>
[[gnu::always_inline]] inline void functions_at(const double* powers, Lanes xi, Lanes (&sum)[n]) {
  unroll<n>([&](int k) { sum[k] = powers[k]; });
  unroll<n - 1>([&](int m) { unroll<n>([&](int k) { sum[k] = sum[k] * xi + powers[(m + 1) * n + k]; }); });
}

}  // namespace mpm::MPM_ISA
