#pragma once

#include <cstdint>
#include <vector>

#include "solver/sph/pairs/entry_rows.hpp"
#include "solver/sph/pairs/pair_loops.hpp"

namespace mpm::sph {

/// Particles in vectors, and the windows of rows that hold whatever is near them.
class PairWindows {
 public:
  /// Windows with all entries closer than `reach` [m] to each of the first `fluid` entries, as they stood
  /// when the rows were built.
  void rebuild(const EntryRows& rows, const VectorField& position, std::size_t fluid, double reach,
               int lanes);

  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }
  [[nodiscard]] const std::vector<Window>& windows() const { return windows_; }
  /// Of a particle: its place in arrays with a number for every lane of every group.
  [[nodiscard]] std::size_t place(std::size_t particle) const { return place_[particle]; }
  [[nodiscard]] std::size_t particles() const { return place_.size(); }
  [[nodiscard]] std::size_t places() const { return groups_.size() * lanes_; }
  /// Numbers in an array with one for every pair.
  [[nodiscard]] std::size_t pairs() const { return pairs_; }

 private:
  void add_groups(const EntryRows& rows, std::size_t fluid);
  void add_windows(const EntryRows& rows, const VectorField& position, double reach, EntryRows::Kind kind,
                   const Group& group);

  std::size_t lanes_ = 1, pairs_ = 0;
  std::vector<Group> groups_;
  std::vector<Window> windows_;
  std::vector<std::size_t> place_;
};

}  // namespace mpm::sph
