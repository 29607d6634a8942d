#include "solver/sph/pairs/entry_rows.hpp"

#include <algorithm>
#include <cmath>

#include "solver/sph/pairs/pair_loops.hpp"

namespace mpm::sph {

long EntryRows::row_at(double y) const {
  return static_cast<long>(std::floor(y / height_)) - lowest_;
}

std::span<const EntryRows::Row> EntryRows::rows(Kind kind, double low, double high) const {
  const auto last = static_cast<long>(count_);
  const auto begin = static_cast<std::size_t>(std::clamp(row_at(low), 0L, last));
  const auto end = static_cast<std::size_t>(std::clamp(row_at(high) + 1, 0L, last));
  return rows(kind).subspan(begin, std::max(begin, end) - begin);
}

void EntryRows::rebuild(const VectorField& position, std::size_t wall_begin, double height) {
  height_ = height;
  lowest_ = 0;
  long low = row_at(position.front().y()), high = low;
  std::vector<long> row(position.size());
  for (std::size_t e = 0; e < position.size(); ++e) {
    row[e] = row_at(position[e].y());
    low = std::min(low, row[e]);
    high = std::max(high, row[e]);
  }
  lowest_ = low;
  count_ = static_cast<std::size_t>(high - low + 1);

  rows_.assign(2 * count_, {});
  const auto row_of = [&](std::size_t e) -> Row& {
    return rows_[static_cast<std::size_t>(row[e] - low) + (e < wall_begin ? 0 : count_)];
  };
  for (std::size_t e = 0; e < position.size(); ++e) ++row_of(e).end;
  std::uint32_t next = most_lanes;
  for (Row& r : rows_) {
    const std::uint32_t size = r.end;
    r.begin = r.end = next;
    if (size > 0) next += size + most_lanes;
  }
  entry_.assign(next, 0);
  for (std::size_t e = 0; e < position.size(); ++e) entry_[row_of(e).end++] = static_cast<std::uint32_t>(e);

  slot_.resize(position.size());
  along_.assign(next, 0);
  for (Row& r : rows_) {
    if (r.begin == r.end) continue;
    std::sort(entry_.begin() + r.begin, entry_.begin() + r.end, [&](std::uint32_t a, std::uint32_t b) {
      return position[a].x() < position[b].x() || (position[a].x() == position[b].x() && a < b);
    });
    r.low = r.high = position[entry_[r.begin]].y();
    for (std::uint32_t slot = r.begin; slot < r.end; ++slot) {
      const Vec2& x = position[entry_[slot]];
      slot_[entry_[slot]] = slot;
      along_[slot] = x.x();
      r.low = std::min(r.low, x.y());
      r.high = std::max(r.high, x.y());
    }
  }
}

}  // namespace mpm::sph
