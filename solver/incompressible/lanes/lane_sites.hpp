#pragma once

#include <algorithm>

#include "solver/incompressible/lanes/site_kernel.hpp"
#include "solver/kernel/cells/storage.hpp"
#include "solver/kernel/lanes.hpp"

namespace mpm::MPM_ISA {

/// What sites have in vectors of `width` neighbouring cells, of n points and n functions a cell along each
/// axis; zero in lanes beyond the last cell.
class SiteBlocks {
 public:
  SiteBlocks(const SiteSetup& setup, int n)
      : setup_(setup), n_(n), blocks_((setup.cells[0] + width - 1) / width) {}

  /// The functions along x: [block][point][derivative][function].
  [[nodiscard]] LargeArray<Lanes> functions_x() const {
    LargeArray<Lanes> functions;
    for (int block = 0; block < blocks_; ++block)
      for (int g = 0; g < n_; ++g)
        for (const std::vector<double>& of : setup_.functions[0])
          for (int a = 0; a < n_; ++a)
            functions.push_back(
                of_cells(block, [&](int cell) { return of[index((cell * n_ + g) * n_ + a)]; }));
    return functions;
  }
  /// The area that a site stands for [m2]: [row][block][point along y][point along x].
  [[nodiscard]] LargeArray<Lanes> weights() const {
    LargeArray<Lanes> weights;
    for (int row = 0; row < setup_.cells[1]; ++row)
      for (int block = 0; block < blocks_; ++block)
        for (int gy = 0; gy < n_; ++gy)
          for (int gx = 0; gx < n_; ++gx)
            weights.push_back(of_cells(block, [&](int cell) {
              return setup_.weights[0][index(cell * n_ + gx)] * setup_.weights[1][index(row * n_ + gy)];
            }));
    return weights;
  }

 private:
  static std::size_t index(int n) { return static_cast<std::size_t>(n); }
  template <class Value>
  [[nodiscard]] Lanes of_cells(int block, const Value& of_cell) const {
    Lanes values = 0;
    for (int lane = 0; lane < std::min(width, setup_.cells[0] - block * width); ++lane)
      values[lane] = of_cell(block * width + lane);
    return values;
  }

  const SiteSetup& setup_;
  int n_, blocks_;
};

/// Sites in vectors of `width` neighbouring cells: of each row of cells, each block of cells, each point
/// along y, each along x. Sums over functions are factorised: along one axis, then along the other.
template <int k>
class LaneSites final : public SiteKernel {
 public:
  explicit LaneSites(const SiteSetup& setup)
      : cells_(setup.cells),
        blocks_((setup.cells[0] + width - 1) / width),
        functions_x_(SiteBlocks(setup, n).functions_x()),
        per_derivative_(setup.functions[1][0].size()),
        weights_(SiteBlocks(setup, n).weights()) {
    for (const std::vector<double>& of : setup.functions[1])
      functions_y_.insert(functions_y_.end(), of.begin(), of.end());
  }

  [[nodiscard]] int size() const override { return static_cast<int>(weights_.size()) * width; }
  [[nodiscard]] const double* weights() const override {
    return reinterpret_cast<const double*>(weights_.data());
  }

  [[gnu::flatten]] void rates(const double* psi, double* xy, double* shear) const override {
    LargeArray<Lanes> memory = room();
    double* const functions = reinterpret_cast<double*>(memory.data());
    for (int j = 0; j < rows(); ++j) std::copy_n(psi + j * columns(), columns(), functions + j * stride());
    for (int row = 0; row < cells_[1]; ++row)
      for (int block = 0; block < blocks_; ++block) {
        Lanes of[n][n];
        for (int b = 0; b < n; ++b)
          unroll<n>([&](int a) { of[b][a] = load(functions + (row + b) * stride() + block * width + a); });
        for (int gy = 0; gy < n; ++gy) {
          Lanes along_y[3][n] = {};
          for (int d = 0; d < 3; ++d)
            for (int b = 0; b < n; ++b) {
              const Lanes of_y = function_y(row, gy, d, b);
              unroll<n>([&](int a) { along_y[d][a] += of_y * of[b][a]; });
            }
          for (int gx = 0; gx < n; ++gx) {
            const Lanes* const x = function_x(block, gx);
            Lanes of_xy = 0, of_shear = 0;
            unroll<n>([&](int a) {
              of_xy += x[slope * n + a] * along_y[slope][a];
              of_shear += x[value * n + a] * along_y[curvature][a];
              of_shear -= x[curvature * n + a] * along_y[value][a];
            });
            const int at = site(row, block, gy, gx);
            store(xy + at, of_xy);
            store(shear + at, of_shear);
          }
        }
      }
  }

  [[gnu::flatten]] void add_forces(const double* of_xy, const double* of_shear, double* sums) const override {
    LargeArray<Lanes> memory = room();
    double* const functions = reinterpret_cast<double*>(memory.data());
    for (int row = 0; row < cells_[1]; ++row)
      for (int block = 0; block < blocks_; ++block) {
        Lanes of[n][n] = {};
        for (int gy = 0; gy < n; ++gy) {
          Lanes along_x[3][n] = {};  // to go with the derivative along y
          for (int gx = 0; gx < n; ++gx) {
            const Lanes* const x = function_x(block, gx);
            const int at = site(row, block, gy, gx);
            const Lanes f_xy = load(of_xy + at), f_shear = load(of_shear + at);
            unroll<n>([&](int a) {
              along_x[slope][a] += f_xy * x[slope * n + a];
              along_x[curvature][a] += f_shear * x[value * n + a];
              along_x[value][a] -= f_shear * x[curvature * n + a];
            });
          }
          for (int d = 0; d < 3; ++d)
            for (int b = 0; b < n; ++b) {
              const Lanes of_y = function_y(row, gy, d, b);
              unroll<n>([&](int a) { of[b][a] += of_y * along_x[d][a]; });
            }
        }
        // Neighbouring functions along x are of overlapping vectors: as late as possible after each other.
        for (int a = 0; a < n; ++a)
          for (int b = 0; b < n; ++b) {
            double* const to = functions + (row + b) * stride() + block * width + a;
            store(to, load(to) + of[b][a]);
          }
      }
    for (int j = 0; j < rows(); ++j)
      for (int i = 0; i < columns(); ++i) sums[j * columns() + i] += functions[j * stride() + i];
  }

  [[gnu::flatten]] void tangents(const double* c_xx, const double* c_xs, const double* c_ss, TakeBlock take,
                                 void* context) const override {
    constexpr int size = n * n;
    for (int row = 0; row < cells_[1]; ++row)
      for (int block = 0; block < blocks_; ++block) {
        Lanes entries[size * (size + 1) / 2] = {};
        for (int gy = 0; gy < n; ++gy)
          for (int gx = 0; gx < n; ++gx) {
            const int at = site(row, block, gy, gx);
            const Lanes xx = load(c_xx + at), xs = load(c_xs + at), ss = load(c_ss + at);
            const Lanes* const x = function_x(block, gx);
            Lanes of_xy[size], of_shear[size];
            for (int b = 0; b < n; ++b) {
              const Lanes y[3] = {function_y(row, gy, 0, b), function_y(row, gy, 1, b),
                                  function_y(row, gy, 2, b)};
              unroll<n>([&](int a) {
                of_xy[b * n + a] = x[slope * n + a] * y[slope];
                of_shear[b * n + a] = x[value * n + a] * y[curvature] - x[curvature * n + a] * y[value];
              });
            }
            Lanes* entry = entries;
            for (int c = 0; c < size; ++c) {
              const Lanes by_xy = xx * of_xy[c] + xs * of_shear[c],
                          by_shear = xs * of_xy[c] + ss * of_shear[c];
              for (int r = 0; r <= c; ++r, ++entry) *entry += of_xy[r] * by_xy + of_shear[r] * by_shear;
            }
          }
        for (int lane = 0; lane < std::min(width, cells_[0] - block * width); ++lane)
          take(context, block * width + lane, row, reinterpret_cast<const double*>(entries) + lane, width);
      }
  }

 private:
  static constexpr int n = k + 1;
  static constexpr int value = 0, slope = 1, curvature = 2;

  static std::size_t index(int cell, int g, int a) {
    return static_cast<std::size_t>((cell * n + g) * n + a);
  }
  [[nodiscard]] int site(int row, int block, int gy, int gx) const {
    return (((row * blocks_ + block) * n + gy) * n + gx) * width;
  }
  [[nodiscard]] const Lanes* function_x(int block, int g) const {
    return functions_x_.data() + (block * n + g) * 3 * n;
  }
  [[nodiscard]] Lanes function_y(int row, int g, int d, int b) const {
    return functions_y_[static_cast<std::size_t>(d) * per_derivative_ + index(row, g, b)];
  }

  [[nodiscard]] int rows() const { return cells_[1] + k; }
  [[nodiscard]] int columns() const { return cells_[0] + k; }
  /// Of rows of functions, which the lanes beyond the last cell reach past.
  [[nodiscard]] int stride() const { return (blocks_ + 1) * width + k / width * width; }
  [[nodiscard]] LargeArray<Lanes> room() const {
    return LargeArray<Lanes>(static_cast<std::size_t>(rows() * stride() / width + 1), Lanes(0));
  }

  std::array<int, 2> cells_;
  int blocks_;
  LargeArray<Lanes> functions_x_;  // [block][point][derivative][function]
  std::size_t per_derivative_;
  LargeArray<double> functions_y_;  // [derivative][row][point][function]
  LargeArray<Lanes> weights_;
};

}  // namespace mpm::MPM_ISA
