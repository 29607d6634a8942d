#pragma once

#include <algorithm>
#include <array>

#include "solver/kernel/kernel.hpp"
#include "solver/kernel/lanes.hpp"
#include "solver/kernel/storage.hpp"

namespace mpm::MPM_ISA {

/// Nodes row by row, each row beginning with a whole vector, with a margin of `degree` nodes all around that
/// holds images where the grid is periodic and nothing beyond walls: whatever reads neighbours reads them
/// everywhere alike.
class Lattice {
 public:
  Lattice(const std::array<LineOfCells, 2>& axis, int degree) : degree_(degree) {
    for (std::size_t a : {0, 1}) {
      cells_[a] = axis[a].cells;
      periodic_[a] = axis[a].periodic;
      count_[a] = axis[a].cells + (axis[a].periodic ? 0 : degree);
    }
    // Rows that lie a power of two apart would compete for the same lines of the cache.
    stride_ = whole_vectors(cells_[0] + 2 * degree);
    if (stride_ % 64 == 0) stride_ += std::max(width, 8);
  }

  [[nodiscard]] int stride() const { return stride_; }
  [[nodiscard]] int degree() const { return degree_; }
  /// Nodes along an axis that have a value of their own.
  [[nodiscard]] int count(int axis) const { return count_[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] bool periodic(int axis) const { return periodic_[static_cast<std::size_t>(axis)]; }
  /// Of a field: before its first node; in all.
  [[nodiscard]] std::size_t margin() const {
    return static_cast<std::size_t>(whole_vectors(degree_ * stride_ + degree_));
  }
  [[nodiscard]] std::size_t size() const {
    return margin() + static_cast<std::size_t>((cells_[1] + 2 * degree_ + 1) * stride_ + 4 * width);
  }

  /// f(i) for the vectors i to i + width - 1 of nodes, row by row. The last of a row reaches into the margin.
  template <class F>
  [[gnu::always_inline]] void each_vector(F&& f) const {
    for (int row = 0; row < count_[1]; ++row)
      for (int i = row * stride_; i < row * stride_ + count_[0]; i += width) f(i);
  }

  /// Moves what stands at the images of periodic nodes beyond the last cells to the nodes themselves.
  void join_images(double* field) const {
    const int end = cells_[0] + degree_;
    const auto move = [field](int from, int to) {
      field[to] += field[from];
      field[from] = 0;
    };
    if (periodic_[1])
      for (int row = cells_[1]; row < cells_[1] + degree_; ++row)
        for (int i = 0; i < end; ++i) move(row * stride_ + i, row % cells_[1] * stride_ + i);
    if (periodic_[0])
      for (int row = 0; row < count_[1]; ++row)
        for (int i = cells_[0]; i < end; ++i) move(row * stride_ + i, row * stride_ + i % cells_[0]);
  }

  /// Sets the margin.
  void fill_margin(double* field) const {
    for (int row = 0; row < count_[1]; ++row) {
      double* const at = field + row * stride_;
      for (int d = 1; d <= degree_; ++d) {
        at[-d] = periodic_[0] ? at[before(d, 0)] : 0;
        at[count_[0] - 1 + d] = periodic_[0] ? at[(d - 1) % cells_[0]] : 0;
      }
    }
    for (int d = 1; d <= degree_; ++d) {
      copy_row(field, before(d, 1), -d);
      copy_row(field, (d - 1) % cells_[1], count_[1] - 1 + d);
    }
  }

  static int whole_vectors(int n) { return (n + width - 1) / width * width; }

 private:
  /// The node of which the d-th before the first is an image.
  [[nodiscard]] int before(int d, std::size_t axis) const {
    return (cells_[axis] - d % cells_[axis]) % cells_[axis];
  }
  void copy_row(double* field, int from, int to) const {
    double* const begin = field + to * stride_ - degree_;
    const int length = count_[0] + 2 * degree_;
    if (periodic_[1])
      std::copy_n(field + from * stride_ - degree_, length, begin);
    else
      std::fill_n(begin, length, 0.0);
  }

  int degree_, stride_;
  std::array<int, 2> cells_, count_;
  std::array<bool, 2> periodic_;
};

/// Some fields on a lattice, zero at first.
template <std::size_t fields>
class LatticeFields {
 public:
  explicit LatticeFields(const Lattice& lattice) : margin_(lattice.margin()) {
    // As NodalFields: not at the same place in their pages.
    constexpr std::size_t page = 4096 / sizeof(double), apart = 9 * 64 / sizeof(double);
    pitch_ = (lattice.size() + page - 1) / page * page + apart;
    memory_.assign(fields * pitch_ / static_cast<std::size_t>(width), Lanes(0));
  }

  /// Node 0 of a field.
  [[nodiscard]] double* operator[](std::size_t field) {
    return reinterpret_cast<double*>(memory_.data()) + field * pitch_ + margin_;
  }
  [[nodiscard]] const double* operator[](std::size_t field) const {
    return reinterpret_cast<const double*>(memory_.data()) + field * pitch_ + margin_;
  }
  /// From a field to the next.
  [[nodiscard]] std::size_t pitch() const { return pitch_; }
  void clear() { std::fill(memory_.begin(), memory_.end(), Lanes(0)); }

 private:
  std::size_t margin_, pitch_;
  LargeArray<Lanes> memory_;
};

/// Both components of a nodal field.
using LatticeVector = LatticeFields<2>;

}  // namespace mpm::MPM_ISA
