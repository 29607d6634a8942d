#pragma once

#include <algorithm>
#include <array>

#include "solver/kernel/cell_weights.hpp"
#include "solver/kernel/cells/storage.hpp"

namespace mpm::MPM_ISA {

/// The fields that particles and grid exchange, numbered like cells (NodeFields), and loops over nodes.
class NodalFields {
 public:
  using Pair = std::array<double*, 2>;

  /// `count` cells along each axis, `rows` of nodes that are `stride` apart; `size` is how far blocks reach.
  NodalFields(const std::array<int, 2>& count, const std::array<bool, 2>& periodic, int rows, int stride,
              std::size_t size)
      : count_(count), periodic_(periodic), rows_(rows), stride_(stride) {
    // Fields begin some cache lines apart modulo a page: at the same place in their pages they would compete
    // for the same lines of the cache.
    constexpr std::size_t page = 4096 / sizeof(double), apart = 9 * 64 / sizeof(double);
    field_size_ = (size + page - 1) / page * page + apart;
    fields_.assign(field_count * field_size_ / static_cast<std::size_t>(width), Lanes(0));
  }

  /// 1/m_i; mass until a part is complete; zero where there is none.
  [[nodiscard]] double* inverse_mass() { return field(first_mass); }
  [[nodiscard]] Pair velocity() { return {field(first_velocity), field(first_velocity + 1)}; }
  /// Of updated particles that have not moved yet.
  [[nodiscard]] Pair mapped() { return {field(first_mapped), field(first_mapped + 1)}; }
  /// Force until a part is complete.
  [[nodiscard]] Pair acceleration() { return {field(first_acceleration), field(first_acceleration + 1)}; }

  /// Brings what every step uses of a node into the cache.
  [[gnu::always_inline]] void fetch(int i) const {
    const auto first = reinterpret_cast<const double*>(fields_.data()) + i;
    for (std::size_t f = 0; f < field_count; ++f)
      if (f < first_mapped || f >= first_acceleration) fetch_ahead(first + f * field_size_);
  }

  /// Sets rows of nodes to zero.
  void clear(double* node, Rows rows) const {
    std::fill(node + rows.begin * stride_, node + rows.end * stride_, 0.0);
  }

  /// f(i, count) for the nodes i to i + count - 1, until those of all the rows are done; count is `width`, a
  /// constant, but at the end.
  template <class F>
  void each_node(Rows rows, F&& f) const {
    const int end = rows.end * stride_;
    int i = rows.begin * stride_;
    for (; i + width <= end; i += width) f(i, std::integral_constant<int, width>());
    if (i < end) f(i, end - i);
  }

  /// Adds up the shares of periodic nodes and their images, and gives all of them the sum. Images across the
  /// lanes are complete when their nodes are.
  void join_images(double* node, Rows rows) const {
    const int across = periodic_[1] ? count_[1] : rows_;
    for (int row = rows.begin; row < std::min(rows.end, across); ++row) {
      double* const here = node + row * stride_;
      for (int image = row + across; image < rows_; image += across)
        for (int i = 0; i < stride_; ++i) here[i] += node[image * stride_ + i];
      if (periodic_[0]) join_along(here);
      for (int image = row + across; image < rows_; image += across)
        std::copy_n(here, stride_, node + image * stride_);
    }
  }

 private:
  static constexpr std::size_t first_mass = 0, first_velocity = 1, first_mapped = 3, first_acceleration = 5,
                               field_count = 7;

  [[nodiscard]] double* field(std::size_t f) {
    return reinterpret_cast<double*>(fields_.data()) + f * field_size_;
  }

  /// Images lie beyond the last cell of a row, more than once around it when it is very short.
  void join_along(double* row) const {
    const int along = count_[0];
    for (int begin = along; begin < stride_; begin += along)
      for (int k = begin; k < std::min(begin + along, stride_); ++k) row[k - begin] += row[k];
    for (int k = along; k < stride_; ++k) row[k] = row[k - along];
  }

  std::array<int, 2> count_;
  std::array<bool, 2> periodic_;
  int rows_, stride_;
  std::size_t field_size_;    // from one field to the next
  LargeArray<Lanes> fields_;  // one after another
};

}  // namespace mpm::MPM_ISA
