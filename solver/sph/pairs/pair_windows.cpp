#include "solver/sph/pairs/pair_windows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm::sph {
namespace {

/// Slots of a row whose x lies within an interval, found from where the last ones were: particles of a group
/// follow each other, and so do their intervals.
class Span {
 public:
  Span(const EntryRows& rows, const EntryRows::Row& row, double around)
      : rows_(rows), row_(row), begin_(rows.first_from(row, around)), end_(begin_) {}

  void move_to(double low, double high) {
    begin_ = first_from(begin_, low);
    end_ = first_from(end_, high);
  }
  [[nodiscard]] std::int64_t begin() const { return begin_; }
  [[nodiscard]] std::int64_t end() const { return end_; }

 private:
  [[nodiscard]] std::uint32_t first_from(std::uint32_t slot, double x) const {
    while (slot > row_.begin && rows_.along(slot - 1) >= x) --slot;
    while (slot < row_.end && rows_.along(slot) < x) ++slot;
    return slot;
  }

  const EntryRows& rows_;
  const EntryRows::Row& row_;
  std::uint32_t begin_, end_;
};

}  // namespace

void PairWindows::rebuild(const EntryRows& rows, const VectorField& position, std::size_t fluid, double reach,
                          int lanes) {
  lanes_ = static_cast<std::size_t>(lanes);
  place_.resize(fluid);
  groups_.clear();
  windows_.clear();
  pairs_ = 0;
  add_groups(rows, fluid);
  for (Group& group : groups_) {
    const auto here = [&] { return static_cast<std::uint32_t>(windows_.size()); };
    group.first_slope = pairs_;
    group.begin = here();
    add_windows(rows, position, reach, EntryRows::Kind::Inner, group);
    group.walls = here();
    add_windows(rows, position, reach, EntryRows::Kind::Wall, group);
    group.end = here();
  }
}

/// As many neighbours of the fluid as there are lanes; copies, which may lie between them, begin another.
void PairWindows::add_groups(const EntryRows& rows, std::size_t fluid) {
  for (const EntryRows::Row& row : rows.rows(EntryRows::Kind::Inner)) {
    bool is_open = false;
    for (std::uint32_t slot = row.begin; slot < row.end; ++slot) {
      const std::size_t entry = rows.entry(slot);
      if (entry >= fluid) {
        is_open = false;
        continue;
      }
      if (!is_open) groups_.push_back({slot, 0, 0, 0, 0, 0});
      place_[entry] = (groups_.size() - 1) * lanes_ + groups_.back().count;
      is_open = ++groups_.back().count < lanes_;
    }
  }
}

void PairWindows::add_windows(const EntryRows& rows, const VectorField& position, double reach,
                              EntryRows::Kind kind, const Group& group) {
  double low = position[rows.entry(group.slot)].y(), high = low;
  for (std::uint32_t lane = 1; lane < group.count; ++lane) {
    const double y = position[rows.entry(group.slot + lane)].y();
    low = std::min(low, y);
    high = std::max(high, y);
  }
  for (const EntryRows::Row& row : rows.rows(kind, low - reach, high + reach)) {
    if (row.begin == row.end) continue;
    Span span(rows, row, rows.along(group.slot));
    std::int64_t first = std::numeric_limits<std::int64_t>::max(), end = 0;
    for (std::uint32_t lane = 0; lane < group.count; ++lane) {
      const Vec2& x = position[rows.entry(group.slot + lane)];
      const double across = std::max({row.low - x.y(), x.y() - row.high, 0.0});
      if (across >= reach) continue;
      const double along = std::sqrt(reach * reach - across * across);
      span.move_to(x.x() - along, x.x() + along);
      if (span.begin() == span.end()) continue;
      first = std::min(first, span.begin() - lane);
      end = std::max(end, span.end() - lane);
    }
    if (first >= end) continue;
    windows_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - first)});
    pairs_ += windows_.back().count * lanes_;
  }
}

}  // namespace mpm::sph
