#pragma once

#include "solver/incompressible/lanes/function_rows.hpp"

namespace mpm::MPM_ISA {

/// Solves M z = r with the mass of the uniform fluid, a product of two lines': by the factor of one line for
/// all others at once, a lane each, along y and, turned over, along x.
class PlaneMass {
 public:
  PlaneMass(const FunctionRows& rows, const LineFactor& along_x, const LineFactor& along_y)
      : rows_(rows),
        along_x_(along_x),
        along_y_(along_y),
        turned_stride_(whole_vectors(rows.unknowns(1)) +
                       (whole_vectors(rows.unknowns(1)) % 64 == 0 ? 8 : 0)) {}

  /// Memory that a solve needs.
  using Scratch = LargeArray<Lanes>;
  [[nodiscard]] Scratch scratch() const {
    return Scratch(static_cast<std::size_t>((turned_stride_ + width) * whole_vectors(rows_.unknowns(0))) /
                           static_cast<std::size_t>(width) +
                       8,
                   Lanes(0));
  }

  /// z is zero but at unknowns.
  [[gnu::flatten]] void solve(const double* r, double* z, Scratch& scratch) const {
    const int stride = rows_.stride();
    const std::ptrdiff_t first = rows_.first_unknown(1) * stride;
    solve_line(along_y_, r + first, z + first, stride, rows_.count(0));
    double* const turned = reinterpret_cast<double*>(scratch.data());
    double* const begin = z + first + rows_.first_unknown(0);
    transpose(begin, stride, rows_.unknowns(1), rows_.unknowns(0), turned, turned_stride_);
    solve_line(along_x_, turned, turned, turned_stride_, rows_.unknowns(1));
    transpose(turned, turned_stride_, rows_.unknowns(0), rows_.unknowns(1), begin, stride);
  }

 private:
  /// For `count` lines, whose unknowns are rows: L y = r, then L^T x = y.
  static void solve_line(const LineFactor& factor, const double* r, double* x, int stride, int count) {
    const int rows = static_cast<int>(factor.inverse_diagonal.size());
    for (int u = 0; u < rows; ++u) substitute(factor, factor.rows, u, r, x, stride, count);
    for (int u = rows - 1; u >= 0; --u) substitute(factor, factor.columns, u, x, x, stride, count);
  }

  [[gnu::always_inline]] static void substitute(const LineFactor& factor, const LineFactor::Entries& entries,
                                                int u, const double* r, double* x, int stride, int count) {
    const auto row = static_cast<std::size_t>(u);
    const int begin = entries.begin[row], end = entries.begin[row + 1];
    const Lanes inverse = factor.inverse_diagonal[row];
    for (int i = 0; i < count; i += width) {
      Lanes sum = load(r + u * stride + i);
      for (int k = begin; k < end; ++k)
        sum -= entries.value[static_cast<std::size_t>(k)] *
               load(x + entries.other[static_cast<std::size_t>(k)] * stride + i);
      store(x + u * stride + i, inverse * sum);
    }
  }

  static void transpose(const double* from, int from_stride, int rows, int columns, double* to,
                        int to_stride) {
    constexpr int tile = 8;
    for (int j = 0; j < rows; j += tile)
      for (int i = 0; i < columns; i += tile)
        for (int b = j; b < std::min(j + tile, rows); ++b)
          for (int a = i; a < std::min(i + tile, columns); ++a)
            to[a * to_stride + b] = from[b * from_stride + a];
  }

  const FunctionRows& rows_;
  const LineFactor &along_x_, &along_y_;
  int turned_stride_;
};

}  // namespace mpm::MPM_ISA
