#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/linear_algebra.hpp"

namespace mpm::sph {

/// Slots of entries: in rows along x as high as the spacing of the lattice, each in the order of x, between
/// empty slots. The fluid and its copies lie in rows of their own, and so does what belongs to walls.
class EntryRows {
 public:
  struct Row {
    std::uint32_t begin = 0, end = 0;  ///< slots
    double low = 0, high = 0;          ///< what its entries reach across [m]
  };
  enum class Kind { Inner, Wall };

  /// Entries from `wall_begin` on belong to walls. `height` [m]: of a row.
  void rebuild(const VectorField& position, std::size_t wall_begin, double height);

  [[nodiscard]] std::span<const std::uint32_t> slots() const { return slot_; }  ///< of the entries
  [[nodiscard]] std::size_t slot_count() const { return entry_.size(); }        ///< empty ones included
  /// Entry in a slot that is not empty.
  [[nodiscard]] std::uint32_t entry(std::uint32_t slot) const { return entry_[slot]; }
  /// x of the entry in a slot as the rows were built [m].
  [[nodiscard]] double along(std::uint32_t slot) const { return along_[slot]; }

  [[nodiscard]] std::span<const Row> rows(Kind kind) const {
    return std::span(rows_).subspan(kind == Kind::Inner ? 0 : count_, count_);
  }
  /// Rows of a kind that may hold entries between two places across.
  [[nodiscard]] std::span<const Row> rows(Kind kind, double low, double high) const;
  /// First slot of a row from which on x is at least so much.
  [[nodiscard]] std::uint32_t first_from(const Row& row, double x) const {
    const auto begin = along_.begin() + row.begin;
    return row.begin +
           static_cast<std::uint32_t>(std::lower_bound(begin, along_.begin() + row.end, x) - begin);
  }
  /// visit(slot) for the entries in a square around a point, and some more.
  template <class Visit>
  void around(Kind kind, const Vec2& point, double reach, const Visit& visit) const {
    for (const Row& row : rows(kind, point.y() - reach, point.y() + reach))
      for (std::uint32_t slot = first_from(row, point.x() - reach);
           slot < row.end && along_[slot] <= point.x() + reach; ++slot)
        visit(slot);
  }

 private:
  [[nodiscard]] long row_at(double y) const;

  double height_ = 1;
  long lowest_ = 0;
  std::size_t count_ = 0;  // of rows of a kind
  std::vector<Row> rows_;  // inner ones, then those of walls
  std::vector<std::uint32_t> slot_, entry_;
  ScalarField along_;
};

}  // namespace mpm::sph
