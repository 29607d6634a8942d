#pragma once

#include <vector>

#include "solver/kernel/kernel.hpp"
#include "solver/kernel/threads/thread_team.hpp"

namespace mpm {

/// The order in which the passes of a step visit the rows of a grid: one pass follows the other a few rows
/// behind, so that a particle is fetched from memory once a step, not once a pass. Row r of cells touches
/// the rows r to r + degree of nodes; a row of nodes is complete when all the cells below it have added to
/// it.
///
///     rows of cells     0 . . . . . . . . . . . . . . . . . . n
///     pass 0            =================>                       P2G
///     pass 1            =============>                           stress and forces, of complete nodes
///     pass 2            =========>                               G2P, of accelerated nodes
///
/// A long grid is cut into segments, which threads sweep independently. At a cut, and where a periodic grid
/// closes, a few rows on either side go first: all passes there, each a little narrower than the one before,
/// as far as nothing is needed from beyond (a trapezoid). Then the segments find the nodes at their ends
/// done. Cuts depend on the grid alone, so that sums are the same whatever the number of threads.
class Sweep {
 public:
  struct Lines {
    int rows;          ///< of cells
    int stride;        ///< from one row to the next, in cells and in nodes
    int degree;        ///< of the basis across the rows; 0 when nothing varies across them
    bool is_periodic;  ///< across the rows: nodes rows + j are images of nodes j < degree
  };
  Sweep(const Lines& lines, int passes);

  /// Cells whose particles and nodes the second cache holds, four particles a cell: smaller grids are visited
  /// by one pass after the other.
  static constexpr int cells_in_cache = 4096;

  /// Visits everything with all passes, on all threads; pass[k] may use what pass[k - 1] completed.
  template <class... Pass>
  void run(ThreadTeam& team, const Pass&... pass) const {
    for (const std::vector<Tasks>* shares : {&cuts_, &segments_})
      team.run(static_cast<int>(shares->size()), [&](int share) {
        for (const Task& task : (*shares)[static_cast<std::size_t>(share)]) {
          int k = 0;
          ((k++ == task.pass ? pass(task.part) : void()), ...);
        }
      });
  }

  /// Number of shares in which the work is done: Part::share is below it.
  [[nodiscard]] int shares() const { return static_cast<int>(cuts_.size() + segments_.size()); }

  struct Task {
    int pass;
    Part part;
  };
  using Tasks = std::vector<Task>;  // in order
  /// Shares that may be done at the same time; the segments when all cuts are done.
  [[nodiscard]] const std::vector<Tasks>& cuts() const { return cuts_; }
  [[nodiscard]] const std::vector<Tasks>& segments() const { return segments_; }

  /// All of a grid at once, for a pass that stands alone.
  static Part whole(const Lines& lines);

 private:
  struct Ends {
    int begin, end;                 ///< rows of cells
    bool cut_at_begin, cut_at_end;  ///< whether a trapezoid stands there
  };
  [[nodiscard]] int lead(int pass) const { return (passes_ - pass) * reach_; }
  [[nodiscard]] Tasks inner_cut(int row, int next) const;
  [[nodiscard]] Tasks closing_cut() const;
  [[nodiscard]] Tasks segment(const Ends& ends) const;

  Lines lines_;
  int passes_;
  int reach_;  ///< rows: cells before row r touch no node of row r + reach or beyond
  std::vector<Tasks> cuts_, segments_;
};

}  // namespace mpm
