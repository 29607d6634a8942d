#pragma once

#include <vector>

#include "solver/incompressible/lanes/function_rows.hpp"

namespace mpm::MPM_ISA {

/// Number of a pair of n functions, each pair once.
constexpr int pair_of(int n, int a, int b) {
  return a <= b ? a * n - a * (a - 1) / 2 + b - a : pair_of(n, b, a);
}

/// Symmetric matrix that couples every function of a component with those that share a cell with it, of
/// nx x ny in each: for every function its couplings with itself and those ahead in the numbering of
/// functions; what couples it with those behind is theirs. Row by row of functions, in each offset by offset.
/// What is the same for all nx and ny; the rest is StencilRows.
class FunctionMatrix {
 public:
  FunctionMatrix(const FunctionRows& rows, int nx, int ny)
      : nx_(nx), ny_(ny), rows_(rows), entries_(rows, offsets(nx, ny)) {
    const int pitch = rows.stride();
    for (int dy = 0; dy < ny; ++dy)
      for (int dx = dy == 0 ? 0 : 1 - nx; dx < nx; ++dx) {
        ahead_.push_back(dy * pitch + dx);
        behind_.push_back((number(dx, dy) - dy * offsets(nx, ny)) * pitch - dx);
      }
    // Neighbouring functions along x add to overlapping vectors: as late as possible after each other.
    for (int k = 0; k < nx; ++k)
      for (int l = 0; l < ny; ++l)
        for (int m = l; m < ny; ++m)
          for (int n = m == l ? k : 0; n < nx; ++n)
            shares_.push_back({(l * offsets(nx, ny) + number(n - k, m - l)) * pitch + k, pair_of(nx, k, n),
                               pair_of(ny, l, m)});
  }
  virtual ~FunctionMatrix() = default;
  FunctionMatrix(const FunctionMatrix&) = delete;
  FunctionMatrix& operator=(const FunctionMatrix&) = delete;

  /// Couplings of a function that are stored.
  static constexpr int offsets(int nx, int ny) { return nx + (ny - 1) * (2 * nx - 1); }

  /// The mass of a uniform fluid times a factor: the product of the lines' masses (LineOfFunctions::mass).
  void set_uniform(const double* mass_x, const double* mass_y, double factor) {
    for (int dy = 0; dy < ny_; ++dy)
      for (int dx = dy == 0 ? 0 : 1 - nx_; dx < nx_; ++dx)
        for (int j = 0; j + dy < rows_.count(1); ++j)
          for (int i = std::max(0, -dx); i < rows_.count(0) - std::max(0, dx); ++i)
            row(j)[number(dx, dy) * rows_.stride() + i] =
                factor * mass_y[dy * rows_.count(1) + j] *
                (dx < 0 ? mass_x[-dx * rows_.count(0) + i + dx] : mass_x[dx * rows_.count(0) + i]);
  }
  void copy(const FunctionMatrix& other) { entries_.copy(other.entries_); }

  /// product = A x, x with its margins zero.
  virtual void multiply(const double* x, double* product) const = 0;

 protected:
  /// From where the cells of a block begin to the entries to which it adds one of its sums.
  struct Share {
    int at, pair_x, pair_y;
  };

  [[nodiscard]] const FunctionRows& rows() const { return rows_; }
  [[nodiscard]] const std::vector<Share>& shares() const { return shares_; }
  /// To the entries of a row of functions.
  [[nodiscard]] double* row(int j) { return entries_.data() + j * offsets(nx_, ny_) * rows_.stride(); }
  [[nodiscard]] const double* row(int j) const {
    return entries_.data() + j * offsets(nx_, ny_) * rows_.stride();
  }
  /// Of every offset: from a function to its partner ahead; to the entry of the partner behind.
  [[nodiscard]] const std::ptrdiff_t* ahead() const { return ahead_.data(); }
  [[nodiscard]] const std::ptrdiff_t* behind() const { return behind_.data(); }

 private:
  /// Of an offset ahead; zero for a function itself.
  [[nodiscard]] int number(int dx, int dy) const {
    return dy == 0 ? dx : nx_ + (dy - 1) * (2 * nx_ - 1) + dx + nx_ - 1;
  }

  int nx_, ny_;
  const FunctionRows& rows_;
  FunctionArray entries_;
  std::vector<std::ptrdiff_t> ahead_, behind_;
  std::vector<Share> shares_;
};

}  // namespace mpm::MPM_ISA
