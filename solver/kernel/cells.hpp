#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "solver/kernel/block_functions.hpp"
#include "solver/kernel/kernel.hpp"
#include "solver/kernel/lanes.hpp"
#include "solver/kernel/storage.hpp"

namespace mpm::MPM_ISA {

/// Particles of `width` neighbouring cells, one of each. An empty lane has no mass and rests in its cell.
struct Slot {
  Lanes s[2], v[2];    ///< place in the cell, 0 to 1 along each axis; velocity [m/s]
  Lanes mass, volume;  ///< per unit depth [kg/m], [m2]; both zero in an empty lane
};

/// Stress of a slot's particles [Pa]. Only schemes that use it in a later pass than the one that sets it keep
/// it, so it lies apart.
struct Stress {
  Lanes s_00, s_11, s_01;

  friend Stress operator*(Lanes factor, const Stress& s) {
    return {factor * s.s_00, factor * s.s_11, factor * s.s_01};
  }
};

/// Affine field of a slot's particles: C_ab times the size of a cell along b, the change of v_a across a
/// cell [m/s]. Only particles of APIC have one.
struct Affine {
  Lanes c[2][2];
};

/// What a slot's particles were called when they came.
struct Names {
  int of[width];
};

/// `width` neighbouring cells and their particles: those of a cell fill the first slots of its lane.
struct Block {
  int first_node;              ///< of the first cell
  int count[width] = {};       ///< particles a cell
  const Lanes* functions[2];   ///< of the basis in these cells (BlockFunctions)
  bool is_uniform;             ///< along either axis in which something varies: no wall is near
  std::size_t first_slot;      ///< in the store of all slots
  int size = 0, capacity = 0;  ///< slots in use, slots reserved
};

struct Address {
  int block, lane, slot;
};

/// All particles, sorted by cell. Cells are numbered like their first nodes, n = row * stride + i; the
/// numbers between rows belong to no cell and stay empty, so that a block may run on into the next row.
class Cells {
 public:
  /// `stride` from a row of cells to the next.
  Cells(const KernelSetup& setup, int stride)
      : axis_(setup.axis),
        stride_(stride),
        functions_(setup.axis, stride, setup.degree),
        is_affine_(setup.is_affine) {
    blocks_.resize(static_cast<std::size_t>((stride_ * axis_[1].cells + width - 1) / width));
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      Block& block = blocks_[b];
      block.first_node = static_cast<int>(b) * width;
      for (int a : {0, 1}) block.functions[a] = functions_.of(block.first_node, a);
      block.is_uniform = functions_.is_uniform(block.functions[0]) &&
                         (setup.strip || functions_.is_uniform(block.functions[1]));
    }
    for (std::size_t p = 0; p < setup.count; ++p) {
      const int number = place_of(setup.points[p]).number(stride_);
      Block& block = blocks_[static_cast<std::size_t>(number / width)];
      block.capacity = std::max(block.capacity, ++block.count[number % width]);
      most_slots_ = std::max(most_slots_, static_cast<std::size_t>(block.capacity));
    }
    for (Block& block : blocks_) std::fill(block.count, block.count + width, 0);
    store_anew();
    for (std::size_t p = 0; p < setup.count; ++p) {
      const PointState& point = setup.points[p];
      const Place place = place_of(point);
      const Address to = add(place.number(stride_));
      name_at(to) = static_cast<int>(p);
      Slot& slot = slot_at(to);
      for (int c : {0, 1}) {
        slot.s[c][to.lane] = place.s[c];
        slot.v[c][to.lane] = point.velocity[c];
      }
      slot.mass[to.lane] = point.mass;
      slot.volume[to.lane] = point.mass / point.density;
      const auto& [s_00, s_11, s_01] = point.stress;
      Stress& stress = stresses_[index_of(to)];
      stress.s_00[to.lane] = s_00;
      stress.s_11[to.lane] = s_11;
      stress.s_01[to.lane] = s_01;
      if (!is_affine_) continue;
      for (int c : {0, 1})
        for (int a : {0, 1})
          affines_[index_of(to)].c[c][a][to.lane] =
              point.affine[c][a] / axis_[static_cast<std::size_t>(a)].inverse_h;
    }
  }

  [[nodiscard]] int stride() const { return stride_; }
  [[nodiscard]] int count() const { return static_cast<int>(blocks_.size()) * width; }
  /// Of a block; the most there ever were.
  [[nodiscard]] std::size_t most_slots() const { return most_slots_; }
  /// What a cell's slots take in the store [B], on average.
  [[nodiscard]] std::ptrdiff_t bytes_a_cell() const {
    return static_cast<std::ptrdiff_t>(end_ * sizeof(Slot)) / count();
  }
  /// The blocks that begin in some rows.
  [[nodiscard]] std::span<const Block> blocks(Rows rows) const {
    const std::size_t begin = first_of_row(rows.begin);
    return {blocks_.data() + begin, first_of_row(rows.end) - begin};
  }
  [[nodiscard]] std::span<Slot> slots(const Block& block) {
    return {slots_.data() + block.first_slot, static_cast<std::size_t>(block.size)};
  }
  [[nodiscard]] std::span<Stress> stresses(const Block& block) {
    return {stresses_.data() + block.first_slot, static_cast<std::size_t>(block.size)};
  }
  /// Empty unless particles carry an affine field.
  [[nodiscard]] std::span<Affine> affines(const Block& block) {
    return {affines_.data() + block.first_slot, is_affine_ ? static_cast<std::size_t>(block.size) : 0};
  }
  [[nodiscard]] bool is_affine() const { return is_affine_; }
  [[nodiscard]] std::span<const Slot> slots(const Block& block) const {
    return {slots_.data() + block.first_slot, static_cast<std::size_t>(block.size)};
  }

  /// Adds the particles of a block that are no longer in their cells to a list.
  [[gnu::noinline]] void list_movers(const Block& block, std::vector<Address>& list) const {
    for (int k = 0; const Slot& slot : slots(block)) {
      const auto& [s, t] = slot.s;
      const Mask left = !((s >= 0) & (s < 1) & (t >= 0) & (t < 1));
      if (left.any())
        for (int lane = 0; lane < width; ++lane)
          if (left[lane]) list.push_back({block.first_node / width, lane, k});
      ++k;
    }
  }

  /// Puts particles that left their cell into the one where they are, around periodic sides. `movers` in the
  /// order of their addresses. False when one is outside the domain or nowhere: those stay where they were.
  [[nodiscard]] bool rehouse(const std::vector<Address>& movers) {
    bool inside = true;
    // Backwards, so that filling a gap from the end of a lane never moves one that is still to come.
    for (auto mover = movers.rbegin(); mover != movers.rend(); ++mover) {
      Slot& slot = slot_at(*mover);
      const int from = mover->block * width + mover->lane;
      Place place{{from % stride_, from / stride_}, {slot.s[0][mover->lane], slot.s[1][mover->lane]}};
      const bool here =
          contain(axis_[0], place.cell[0], place.s[0]) && contain(axis_[1], place.cell[1], place.s[1]);
      inside &= here;
      if (!here) continue;
      Address to = *mover;
      if (place.number(stride_) != from) {
        to = add(place.number(stride_));
        copy(*mover, to);
        remove(*mover);
      }
      for (int a : {0, 1}) slot_at(to).s[a][to.lane] = place.s[a];
    }
    return inside;
  }

  /// Writes all particles under their names.
  void gather(PointState* points) const {
    for (const Block& block : blocks_)
      for (int lane = 0; lane < width; ++lane)
        for (int k = 0; k < block.count[lane]; ++k) {
          const int number = block.first_node + lane;
          const std::size_t at = block.first_slot + static_cast<std::size_t>(k);
          const Slot& slot = slots_[at];
          const Stress& stress = stresses_[at];
          PointState& point = points[names_[at].of[lane]];
          point = {{coordinate(axis_[0], number % stride_, slot.s[0][lane]),
                    coordinate(axis_[1], number / stride_, slot.s[1][lane])},
                   {slot.v[0][lane], slot.v[1][lane]},
                   slot.mass[lane],
                   slot.mass[lane] / slot.volume[lane],
                   {stress.s_00[lane], stress.s_11[lane], stress.s_01[lane]},
                   {}};
          if (!is_affine_) continue;
          for (int c : {0, 1})
            for (int a : {0, 1})
              point.affine[c][a] = affines_[at].c[c][a][lane] * axis_[static_cast<std::size_t>(a)].inverse_h;
        }
  }

 private:
  [[nodiscard]] std::size_t first_of_row(int row) const {
    return static_cast<std::size_t>((row * stride_ + width - 1) / width);
  }

  /// Where a particle is: number of its cell along each axis, and place in the cell.
  struct Place {
    int cell[2];
    double s[2];

    [[nodiscard]] int number(int stride) const { return cell[1] * stride + cell[0]; }
  };
  [[nodiscard]] Place place_of(const PointState& point) const {
    Place place;
    for (int a : {0, 1}) {
      const LineOfCells& axis = axis_[static_cast<std::size_t>(a)];
      const double cells = point.position[a] * axis.inverse_h;
      place.cell[a] = std::clamp(static_cast<int>(cells), 0, axis.cells - 1);
      place.s[a] = cells - place.cell[a];
    }
    return place;
  }

  /// [m]; rounding takes no point inside beyond the end.
  static double coordinate(const LineOfCells& axis, int cell, double s) {
    const double x = (cell + s) / axis.inverse_h;
    return s <= 1 ? std::min(x, axis.length) : x;
  }

  /// As Axis::contain, in cells: takes what s has beyond 0 to 1 to the number of the cell. A point on the far
  /// end belongs to the last cell. Whoever crosses more cells in a step than have numbers is nowhere.
  static bool contain(const LineOfCells& axis, int& cell, double& s) {
    constexpr double most = std::numeric_limits<int>::max();
    const double steps = std::floor(s), end = axis.cells;
    if (!(std::abs(steps) < most)) return false;  // nor is what is not finite
    double number = cell + steps;
    if (axis.periodic) number -= end * std::floor(number / end);
    s -= steps;
    if (number == end && s == 0) {
      number = end - 1;
      s = 1;
    }
    if (!(number >= 0 && number < end)) return false;
    cell = static_cast<int>(number);
    return true;
  }

  Block& block_at(const Address& at) { return blocks_[static_cast<std::size_t>(at.block)]; }
  std::size_t index_of(const Address& at) {
    return block_at(at).first_slot + static_cast<std::size_t>(at.slot);
  }
  Slot& slot_at(const Address& at) { return slots_[index_of(at)]; }
  int& name_at(const Address& at) { return names_[index_of(at)].of[at.lane]; }

  /// Makes room for one more particle in a cell.
  Address add(int number) {
    Address at{number / width, number % width, 0};
    Block& block = block_at(at);
    at.slot = block.count[at.lane]++;
    if (at.slot == block.size) {
      if (block.size == block.capacity) grow(block);
      ++block.size;
      slot_at(at) = empty_slot();
      stresses_[index_of(at)] = {0, 0, 0};
      if (is_affine_) affines_[index_of(at)] = {{{0, 0}, {0, 0}}};
    }
    return at;
  }

  /// Moves a block to the end of the store with room to spare; when the end is reached, everything moves.
  [[gnu::noinline]] void grow(Block& block) {
    block.capacity = 2 * std::max(1, block.capacity);
    most_slots_ = std::max(most_slots_, static_cast<std::size_t>(block.capacity));
    if (end_ + static_cast<std::size_t>(block.capacity) > slots_.size()) return store_anew();
    const auto move = [&](auto& array) {
      const auto begin = array.begin();
      std::copy_n(begin + static_cast<std::ptrdiff_t>(block.first_slot), block.size,
                  begin + static_cast<std::ptrdiff_t>(end_));
    };
    move(slots_);
    move(stresses_);
    if (is_affine_) move(affines_);
    move(names_);
    block.first_slot = end_;
    end_ += static_cast<std::size_t>(block.capacity);
  }

  /// A new store of all slots in the order of blocks, with a quarter more for blocks that grow.
  [[gnu::noinline]] void store_anew() {
    std::size_t total = 0;
    for (const Block& block : blocks_) total += static_cast<std::size_t>(block.capacity);
    LargeArray<Slot> slots(total + total / 4 + 16);
    LargeArray<Stress> stresses(slots.size());
    LargeArray<Affine> affines(is_affine_ ? slots.size() : 0);
    LargeArray<Names> names(slots.size());
    end_ = 0;
    for (Block& block : blocks_) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(block.size); ++k) {
        slots[end_ + k] = slots_[block.first_slot + k];
        stresses[end_ + k] = stresses_[block.first_slot + k];
        if (is_affine_) affines[end_ + k] = affines_[block.first_slot + k];
        names[end_ + k] = names_[block.first_slot + k];
      }
      block.first_slot = end_;
      end_ += static_cast<std::size_t>(block.capacity);
    }
    slots_.swap(slots);
    stresses_.swap(stresses);
    affines_.swap(affines);
    names_.swap(names);
  }

  /// The lane's last particle takes the place of the one that goes; slots that no lane uses are dropped.
  void remove(const Address& at) {
    Block& block = block_at(at);
    const Address last{at.block, at.lane, --block.count[at.lane]};
    if (last.slot != at.slot) copy(last, at);
    copy_lane(empty_slot(), slot_at(last), at.lane, at.lane);
    block.size = *std::max_element(block.count, block.count + width);
  }

  void copy(const Address& from, const Address& to) {
    copy_lane(slot_at(from), slot_at(to), from.lane, to.lane);
    const Stress& stress = stresses_[index_of(from)];
    Stress& copied = stresses_[index_of(to)];
    copied.s_00[to.lane] = stress.s_00[from.lane];
    copied.s_11[to.lane] = stress.s_11[from.lane];
    copied.s_01[to.lane] = stress.s_01[from.lane];
    name_at(to) = name_at(from);
    if (!is_affine_) return;
    for (int c : {0, 1})
      for (int a : {0, 1})
        affines_[index_of(to)].c[c][a][to.lane] = affines_[index_of(from)].c[c][a][from.lane];
  }

  static void copy_lane(const Slot& from, Slot& to, int from_lane, int to_lane) {
    for (int c : {0, 1}) {
      to.s[c][to_lane] = from.s[c][from_lane];
      to.v[c][to_lane] = from.v[c][from_lane];
    }
    to.mass[to_lane] = from.mass[from_lane];
    to.volume[to_lane] = from.volume[from_lane];
  }

  static Slot empty_slot() { return {{0.5, 0.5}, {0, 0}, 0, 0}; }

  std::array<LineOfCells, 2> axis_;
  int stride_;
  BlockFunctions functions_;
  bool is_affine_;
  LargeArray<Block> blocks_;
  LargeArray<Slot> slots_;  // of one block after another
  LargeArray<Stress> stresses_;
  LargeArray<Affine> affines_;
  LargeArray<Names> names_;
  std::size_t most_slots_ = 0;
  std::size_t end_ = 0;  // of the slots that blocks have reserved
};

}  // namespace mpm::MPM_ISA
