#include "solver/kernel/threads/sweep.hpp"

#include <algorithm>

namespace mpm {
namespace {

/// Cells by which the first pass advances at a time: long beside the cost of beginning a pass, short enough
/// that these and those ahead stay in the second cache (250 bytes a cell, four particles).
constexpr int cells_at_a_time = 512;
/// From the cells that the first pass visits to those that are fetched meanwhile: more than it advances at a
/// time, by several hundred memory accesses.
constexpr int cells_ahead = 640;
/// What lies at a cut is visited in short parts and fetched twice: the longer a grid, the longer its
/// segments. So many cells allow two segments, 4 times as many 4. In rows, a segment takes at least so many
/// times what a cut takes on one side of it.
constexpr long cells_of_two_segments = 4096;
constexpr int cuts_of_segment = 4;

/// Vectors of the widest registers: cells are visited, and nodes added to, in whole vectors.
constexpr int widest = 8;

}  // namespace

Sweep::Sweep(const Lines& lines, int passes)
    : lines_(lines),
      passes_(passes),
      reach_(lines.degree + 1 + (lines.degree + 2 * widest - 1) / lines.stride) {
  const int rows = lines.rows, cells = lines.stride * rows;
  const int shortest = cuts_of_segment * lead(0);
  if (cells <= cells_in_cache || rows < shortest) {
    segments_.emplace_back();
    for (int pass = 0; pass < passes; ++pass) segments_.back().push_back({pass, whole(lines)});
    return;
  }
  int count = 1;
  while (count * count * cells_of_two_segments <= cells && 2 * count * shortest <= rows) count *= 2;
  if (lines.is_periodic) cuts_.push_back(closing_cut());
  for (int k = 0; k < count; ++k) {
    const int begin = static_cast<int>(static_cast<long>(rows) * k / count);
    const int end = static_cast<int>(static_cast<long>(rows) * (k + 1) / count);
    if (k > 0) cuts_.push_back(inner_cut(begin, end));
    segments_.push_back(
        segment({begin, end, k > 0 || lines.is_periodic, k + 1 < count || lines.is_periodic}));
  }
  int share = 0;
  for (auto* phase : {&cuts_, &segments_})
    for (Tasks& tasks : *phase) {
      for (Task& task : tasks) task.part.share = share;
      ++share;
    }
}

Part Sweep::whole(const Lines& lines) {
  const Rows nodes{0, lines.rows + lines.degree};
  return {nodes, {0, lines.rows}, nodes, 0};
}

/// Around the first nodes of a row inside the grid; meanwhile what lies around `next` is fetched.
Sweep::Tasks Sweep::inner_cut(int row, int next) const {
  Tasks tasks;
  for (int pass = 0; pass < passes_; ++pass) {
    const int from = row - lead(pass), to = row + lead(pass);
    Part part{{from, to + reach_}, {from, to}, {from + reach_, to}};
    if (next < lines_.rows) part.ahead = (next - row) * lines_.stride;
    tasks.push_back({pass, part});
  }
  return tasks;
}

/// Where the last row of a periodic grid meets the first.
Sweep::Tasks Sweep::closing_cut() const {
  const int rows = lines_.rows, images_end = rows + lines_.degree;
  Tasks tasks;
  for (int pass = 0; pass < passes_; ++pass) {
    const int from = rows - lead(pass), to = lead(pass);
    tasks.push_back({pass, {{from, images_end}, {from, rows}, {}}});
    // Images join their nodes when these are complete, then those before them and the images themselves.
    tasks.push_back({pass, {{0, to + reach_}, {0, to}, {0, to}}});
    tasks.push_back({pass, {{}, {}, {from + reach_, images_end}}});
  }
  return tasks;
}

Sweep::Tasks Sweep::segment(const Ends& ends) const {
  struct Front {
    int cells, fresh, complete;
  };
  const int all_nodes = lines_.rows + lines_.degree;
  std::vector<Front> front, last;
  for (int pass = 0; pass < passes_; ++pass) {
    const int from = ends.begin + lead(pass), to = ends.end - lead(pass);
    front.push_back(ends.cut_at_begin ? Front{from, from + reach_, from} : Front{0, 0, 0});
    last.push_back(ends.cut_at_end ? Front{to, to, to + reach_} : Front{ends.end, all_nodes, all_nodes});
  }
  Tasks tasks;
  const int step = std::max(1, cells_at_a_time / lines_.stride);
  for (int first = front[0].cells; first < last[0].cells;) {
    first = std::min(first + step, last[0].cells);
    const bool is_last = first == last[0].cells;
    for (int pass = 0; pass < passes_; ++pass) {
      const auto k = static_cast<std::size_t>(pass);
      Front& now = front[k];
      const int cells = std::max(now.cells, first - pass * reach_);
      const Front next = is_last ? last[k] : Front{cells, std::min(cells + reach_, last[k].fresh), cells};
      if (next.cells == now.cells && !is_last) continue;
      Part part{{now.fresh, next.fresh}, {now.cells, next.cells}, {now.complete, next.complete}};
      part.ahead = cells_ahead + pass * reach_ * lines_.stride;
      tasks.push_back({pass, part});
      now = next;
    }
  }
  return tasks;
}

}  // namespace mpm
