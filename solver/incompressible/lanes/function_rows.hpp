#pragma once

#include <algorithm>
#include <array>

#include "solver/incompressible/lanes/plane_kernel.hpp"
#include "solver/kernel/cells/storage.hpp"
#include "solver/kernel/lanes.hpp"

namespace mpm::MPM_ISA {

constexpr int whole_vectors(int n) {
  return (n + width - 1) / width * width;
}

/// The functions of one component, row by row along x, with a margin of zeros all around: whatever reads
/// neighbours, or whole vectors, reads them everywhere alike. Unknowns are some of the functions: those
/// beyond a period are images of the first ones, and those that walls hold are zero.
class FunctionRows {
 public:
  FunctionRows(const PlaneSetup& setup, int component) {
    margin_ = setup.degree;
    for (std::size_t a : {0, 1}) {
      const LineOfFunctions& line = setup.axis[a];
      const std::size_t less = static_cast<int>(a) == component ? 0 : 1;
      cells_[a] = line.cells;
      periodic_[a] = line.periodic;
      count_[a] = line.cells + setup.degree - static_cast<int>(less);
      unknowns_[a] = line.unknowns[less];
      first_[a] = line.first_unknown[less];
    }
    before_ = whole_vectors(margin_);
    // The lanes of the last cells of a row reach beyond its functions.
    stride_ = before_ + whole_vectors(whole_vectors(cells_[0]) + margin_ + width);
    if (stride_ % 64 == 0) stride_ += std::max(width, 8);  // rows would compete for lines of the cache
  }

  [[nodiscard]] int stride() const { return stride_; }
  /// Functions along an axis.
  [[nodiscard]] int count(int axis) const { return count_[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] int unknowns(int axis) const { return unknowns_[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] int first_unknown(int axis) const { return first_[static_cast<std::size_t>(axis)]; }
  /// Rows of an array of `planes` numbers a function, and where function (0, 0) is in it.
  [[nodiscard]] std::size_t size(int planes = 1) const {
    return static_cast<std::size_t>((count_[1] + 2 * margin_ + 1) * stride_ * planes);
  }
  [[nodiscard]] std::size_t origin(int planes = 1) const {
    return static_cast<std::size_t>(margin_ * stride_ * planes + before_);
  }

  /// f(i) for vectors that cover the unknowns; i counts functions row by row.
  template <class F>
  [[gnu::always_inline]] void each_vector(F&& f) const {
    for (int j = first_[1]; j < first_[1] + unknowns_[1]; ++j)
      for (int i = 0; i < count_[0]; i += width) f(j * stride_ + i);
  }

  /// From unknowns, x fastest, to their functions, and back. Images and margins are left alone.
  void place(const double* unknowns, double* functions) const {
    for (int j = 0; j < unknowns_[1]; ++j)
      std::copy_n(unknowns + j * unknowns_[0], unknowns_[0],
                  functions + (first_[1] + j) * stride_ + first_[0]);
  }
  void collect(const double* functions, double* unknowns) const {
    for (int j = 0; j < unknowns_[1]; ++j)
      std::copy_n(functions + (first_[1] + j) * stride_ + first_[0], unknowns_[0],
                  unknowns + j * unknowns_[0]);
  }

  /// Sets the images of what stands at the unknowns.
  void set_images(double* functions) const {
    if (periodic_[0])
      for (int j = 0; j < std::min(count_[1], periodic_[1] ? cells_[1] : count_[1]); ++j)
        for (int i = cells_[0]; i < count_[0]; ++i)
          functions[j * stride_ + i] = functions[j * stride_ + i % cells_[0]];
    if (periodic_[1])
      for (int j = cells_[1]; j < count_[1]; ++j)
        std::copy_n(functions + j % cells_[1] * stride_, count_[0], functions + j * stride_);
  }

  /// Adds sums over images to those of their unknowns, and drops them and those of functions that walls hold.
  void fold(double* functions) const {
    if (periodic_[1])
      for (int j = cells_[1]; j < count_[1]; ++j)
        for (int i = 0; i < count_[0]; ++i) {
          functions[j % cells_[1] * stride_ + i] += functions[j * stride_ + i];
          functions[j * stride_ + i] = 0;
        }
    if (periodic_[0])
      for (int j = 0; j < count_[1]; ++j)
        for (int i = cells_[0]; i < count_[0]; ++i) {
          functions[j * stride_ + i % cells_[0]] += functions[j * stride_ + i];
          functions[j * stride_ + i] = 0;
        }
    if (first_[1] > 0)
      for (const int j : {0, count_[1] - 1}) std::fill_n(functions + j * stride_, count_[0], 0.0);
    if (first_[0] > 0)
      for (int j = 0; j < count_[1]; ++j) functions[j * stride_] = functions[j * stride_ + count_[0] - 1] = 0;
  }

 private:
  int margin_, before_, stride_;
  std::array<int, 2> cells_, count_, unknowns_, first_;
  std::array<bool, 2> periodic_;
};

/// Numbers of every function of a component, zero at first.
class FunctionArray {
 public:
  explicit FunctionArray(const FunctionRows& rows, int planes = 1)
      : memory_(rows.size(planes) / static_cast<std::size_t>(width) + 1, Lanes(0)),
        origin_(rows.origin(planes)) {}

  /// At function (0, 0).
  [[nodiscard]] double* data() { return reinterpret_cast<double*>(memory_.data()) + origin_; }
  [[nodiscard]] const double* data() const {
    return reinterpret_cast<const double*>(memory_.data()) + origin_;
  }
  void copy(const FunctionArray& other) { memory_ = other.memory_; }
  void clear() { std::fill(memory_.begin(), memory_.end(), Lanes(0)); }

 private:
  LargeArray<Lanes> memory_;
  std::size_t origin_;
};

}  // namespace mpm::MPM_ISA
