#pragma once

#include <algorithm>
#include <array>

#include "solver/kernel/cells/storage.hpp"
#include "solver/kernel/kernel.hpp"
#include "solver/kernel/lanes.hpp"

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
    // Whole vectors of a row reach no margin of the next. Rows that lie a power of two apart would compete
    // for the same lines of the cache.
    stride_ = whole_vectors(whole_vectors(count_[0]) + 2 * degree);
    for (std::size_t a : {0, 1})
      for (int d = 0; d < degree; ++d) {
        after_[a][d] = d % cells_[a];
        before_[a][d] = (degree * cells_[a] + d - degree) % cells_[a];
      }
    if (stride_ % 64 == 0) stride_ += std::max(width, 8);
  }

  [[nodiscard]] int stride() const { return stride_; }
  /// Nodes along an axis that have a value of their own.
  [[nodiscard]] int count(int axis) const { return count_[static_cast<std::size_t>(axis)]; }
  /// Of a node that has a value of its own, the n-th of them.
  [[nodiscard]] int place_of(int n) const { return n / count_[0] * stride_ + n % count_[0]; }
  /// To which cells add, margin and all.
  [[nodiscard]] int rows() const { return cells_[1] + degree_ + 1; }
  [[nodiscard]] bool periodic(int axis) const { return periodic_[static_cast<std::size_t>(axis)]; }
  /// Of a field: before its first node; in all.
  [[nodiscard]] std::size_t margin() const {
    return static_cast<std::size_t>(whole_vectors(degree_ * stride_ + degree_));
  }
  [[nodiscard]] std::size_t size() const {
    return margin() + static_cast<std::size_t>((rows() + degree_) * stride_ + 4 * width);
  }

  /// f(i) for the vectors i to i + width - 1 of some rows of nodes. The last one of a row reaches into the
  /// margin.
  template <class F>
  [[gnu::always_inline]] void each_vector(Rows rows, F&& f) const {
    for (int row = rows.begin; row < rows.end; ++row)
      for (int i = row * stride_; i < row * stride_ + count_[0]; i += width) f(i);
  }

  /// Moves what stands at the images of periodic nodes beyond the last cells to the nodes themselves.
  void join_images(double* field) const {
    const auto move = [field](int from, int to) {
      field[to] += field[from];
      field[from] = 0;
    };
    if (periodic_[1])
      for (int d = 0; d < degree_; ++d)
        for (int i = 0; i < cells_[0] + degree_; ++i)
          move((cells_[1] + d) * stride_ + i, after_[1][d] * stride_ + i);
    if (periodic_[0])
      for (int row = 0; row < count_[1]; ++row)
        for (int d = 0; d < degree_; ++d) move(row * stride_ + cells_[0] + d, row * stride_ + after_[0][d]);
  }

  /// Sets the margin: what of it are images of the nodes of some rows, or lies beside them.
  void fill_margins(double* field, Rows rows) const {
    fill_sides(field, rows);
    if (!periodic_[1]) return;  // zero from the beginning
    for (int row = rows.begin; row < rows.end; ++row) {
      for (int image = row - cells_[1]; image >= -degree_; image -= cells_[1]) copy_row(field, row, image);
      for (int image = row + cells_[1]; image < cells_[1] + degree_; image += cells_[1])
        copy_row(field, row, image);
    }
  }
  /// Sets the margin of a whole field on both sides of its rows, and so many rows of it below them.
  void fill_margins_below(double* field, int rows) const {
    fill_sides(field, {0, count_[1]});
    if (periodic_[1])
      for (int image = -rows; image < 0; ++image) copy_row(field, before_[1][degree_ + image], image);
  }

  static int whole_vectors(int n) { return (n + width - 1) / width * width; }

 private:
  static constexpr int most_degree = 3;

  void fill_sides(double* field, Rows rows) const {
    for (int row = rows.begin; row < rows.end; ++row) {
      double* const at = field + row * stride_;
      for (int d = 0; d < degree_; ++d) {
        at[d - degree_] = periodic_[0] ? at[before_[0][d]] : 0;
        at[count_[0] + d] = periodic_[0] ? at[after_[0][d]] : 0;
      }
    }
  }
  /// In whole vectors, which there is room for.
  void copy_row(double* field, int from, int to) const {
    for (int i = -degree_; i < count_[0] + degree_; i += width)
      store(field + to * stride_ + i, load(field + from * stride_ + i));
  }

  int degree_, stride_;
  std::array<int, 2> cells_, count_;
  std::array<bool, 2> periodic_;
  int before_[2][most_degree], after_[2][most_degree];  // the cells whose images lie before and after others
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
  /// Rows of all fields, from the first node of one to that of another.
  void clear(const Lattice& lattice, Rows rows) {
    for (std::size_t f = 0; f < fields; ++f)
      std::fill((*this)[f] + rows.begin * lattice.stride(), (*this)[f] + rows.end * lattice.stride(), 0.0);
  }

 private:
  std::size_t margin_, pitch_;
  LargeArray<Lanes> memory_;
};

/// Both components of a nodal field.
using LatticeVector = LatticeFields<2>;

/// One number a component.
struct Both {
  double of[2];
};

}  // namespace mpm::MPM_ISA
