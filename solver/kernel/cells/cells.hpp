#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "solver/kernel/cells/block_functions.hpp"
#include "solver/kernel/cells/slots.hpp"
#include "solver/kernel/kernel.hpp"

namespace mpm::MPM_ISA {

/// `width` neighbouring cells and their particles: those of a cell fill the first slots of its lane.
struct Block {
  int first_node;              ///< of the first cell
  int count[width] = {};       ///< particles a cell
  const Lanes* functions[2];   ///< of the basis in these cells (BlockFunctions)
  bool is_uniform;             ///< along either axis in which something varies: no wall is near
  std::size_t first_slot;      ///< in the store of all slots
  int size = 0, capacity = 0;  ///< slots in use, slots reserved
};

/// A particle that left its cell.
struct Mover {
  int cell;  ///< from which
  LoneParticle particle;
};

/// All particles, sorted by cell. Cells are numbered like their first nodes, n = row * stride + i; the
/// numbers between rows belong to no cell and stay empty, so that a block may run on into the next row.
class Cells {
 public:
  /// `stride` from a row of cells to the next.
  Cells(const KernelSetup& setup, int stride)
      : axis_(setup.axis), stride_(stride), store_(setup.is_affine, setup.keeps_stress) {
    const auto functions = std::make_shared<BlockFunctions>(setup.axis, stride, setup.degree);
    functions_ = functions;
    blocks_.resize(static_cast<std::size_t>((stride_ * axis_[1].cells + width - 1) / width));
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      Block& block = blocks_[b];
      block.first_node = static_cast<int>(b) * width;
      for (int a : {0, 1}) block.functions[a] = functions->of(block.first_node, a);
      block.is_uniform = functions->is_uniform(block.functions[0]) &&
                         (setup.strip || functions->is_uniform(block.functions[1]));
    }
    for (std::size_t p = 0; p < setup.count; ++p) {
      const int number = place_of(setup.points[p]).number(stride_);
      Block& block = block_of(number);
      block.capacity = std::max(block.capacity, ++block.count[number % width]);
      most_slots_ = std::max(most_slots_, static_cast<std::size_t>(block.capacity));
    }
    for (Block& block : blocks_) std::fill(block.count, block.count + width, 0);
    store_anew();
    for (std::size_t p = 0; p < setup.count; ++p) {
      const PointState& point = setup.points[p];
      const Place place = place_of(point);
      const auto& v = point.velocity;
      const auto& stress = point.stress;
      LoneParticle particle{static_cast<int>(p),
                            {place.s[0], place.s[1]},
                            {v[0], v[1]},
                            point.mass,
                            point.mass / point.density,
                            {stress[0], stress[1], stress[2]},
                            {}};
      for (int c : {0, 1})
        for (int a : {0, 1})
          particle.affine[c][a] = point.affine[c][a] / axis_[static_cast<std::size_t>(a)].inverse_h;
      add(particle, place.number(stride_));
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
    return store_.slots(block.first_slot, size_of(block));
  }
  [[nodiscard]] std::span<const Slot> slots(const Block& block) const {
    return store_.slots(block.first_slot, size_of(block));
  }
  [[nodiscard]] std::span<Stress> stresses(const Block& block) {
    return store_.stresses(block.first_slot, size_of(block));
  }
  /// Empty unless particles carry an affine field.
  [[nodiscard]] std::span<Affine> affines(const Block& block) {
    return store_.affines(block.first_slot, size_of(block));
  }
  [[nodiscard]] bool is_affine() const { return store_.has_affine(); }

  /// Takes the particles of a block that are no longer in their cells out of it. While they are in the cache,
  /// and by threads that visit other blocks at the same time.
  [[gnu::noinline]] void take_out_movers(const Block& of, std::vector<Mover>& movers) {
    Block& block = block_of(of.first_node);
    // Backwards, so that filling a gap from the end of a lane never moves one that is still to come.
    for (int k = block.size - 1; k >= 0; --k) {
      const auto& [s, t] = slots(block)[static_cast<std::size_t>(k)].s;
      const Mask left = !((s >= 0) & (s < 1) & (t >= 0) & (t < 1));
      if (!left.any()) continue;
      for (int lane = 0; lane < width; ++lane)
        if (left[lane]) movers.push_back({block.first_node + lane, take_out(block, lane, k)});
    }
  }

  /// Puts particles that left their cell into the one where they are, around periodic sides. False when one
  /// is outside the domain or nowhere: those go back to where they were.
  [[nodiscard]] bool rehouse(const std::vector<Mover>& movers) {
    bool inside = true;
    for (auto [cell, particle] : movers) {
      Place place{{cell % stride_, cell / stride_}, {particle.s[0], particle.s[1]}};
      if (contain(axis_[0], place.cell[0], place.s[0]) && contain(axis_[1], place.cell[1], place.s[1])) {
        cell = place.number(stride_);
        for (int a : {0, 1}) particle.s[a] = place.s[a];
      } else {
        inside = false;
      }
      add(particle, cell);
    }
    return inside;
  }

  /// Writes all particles under their names.
  void gather(PointState* points) const {
    for (const Block& block : blocks_)
      for (int lane = 0; lane < width; ++lane)
        for (int k = 0; k < block.count[lane]; ++k) {
          const int number = block.first_node + lane;
          const LoneParticle p = store_.particle(block.first_slot + static_cast<std::size_t>(k), lane, true);
          PointState& point = points[p.name];
          point = {{coordinate(axis_[0], number % stride_, p.s[0]),
                    coordinate(axis_[1], number / stride_, p.s[1])},
                   {p.v[0], p.v[1]},
                   p.mass,
                   p.mass / p.volume,
                   {p.stress[0], p.stress[1], p.stress[2]},
                   {}};
          for (int c : {0, 1})
            for (int a : {0, 1})
              point.affine[c][a] = p.affine[c][a] * axis_[static_cast<std::size_t>(a)].inverse_h;
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

  static std::size_t size_of(const Block& block) { return static_cast<std::size_t>(block.size); }

  [[nodiscard]] Block& block_of(int cell) { return blocks_[static_cast<std::size_t>(cell / width)]; }

  /// Puts one more particle into a cell.
  void add(const LoneParticle& particle, int cell) {
    Block& block = block_of(cell);
    const int lane = cell % width, k = block.count[lane]++;
    if (k == block.size) {
      if (block.size == block.capacity) grow(block);
      store_.empty(block.first_slot + size_of(block));
      ++block.size;
    }
    store_.put(particle, block.first_slot + static_cast<std::size_t>(k), lane);
  }

  /// The lane's last particle takes the place of the one that goes; slots that no lane uses are dropped.
  LoneParticle take_out(Block& block, int lane, int k) {
    const std::size_t at = block.first_slot + static_cast<std::size_t>(k),
                      last = block.first_slot + static_cast<std::size_t>(--block.count[lane]);
    const LoneParticle particle = store_.particle(at, lane);
    if (last != at) store_.put(store_.particle(last, lane), at, lane);
    store_.empty(last, lane);
    block.size = *std::max_element(block.count, block.count + width);
    return particle;
  }

  /// Moves a block to the end of the store with room to spare; when the end is reached, everything moves.
  [[gnu::noinline]] void grow(Block& block) {
    // Not twice: what is reserved and not used lies between what is, and memory brings it along.
    block.capacity += std::max(2, block.capacity / 2);
    most_slots_ = std::max(most_slots_, static_cast<std::size_t>(block.capacity));
    if (end_ + static_cast<std::size_t>(block.capacity) > store_.size()) return store_anew();
    store_.copy(store_, block.first_slot, size_of(block), end_);
    block.first_slot = end_;
    end_ += static_cast<std::size_t>(block.capacity);
  }

  /// A new store of all slots in the order of blocks, with a quarter more for blocks that grow.
  [[gnu::noinline]] void store_anew() {
    std::size_t total = 0;
    for (const Block& block : blocks_) total += static_cast<std::size_t>(block.capacity);
    Slots store = store_.like(total + total / 4 + 16);
    end_ = 0;
    for (Block& block : blocks_) {
      store.copy(store_, block.first_slot, size_of(block), end_);
      block.first_slot = end_;
      end_ += static_cast<std::size_t>(block.capacity);
    }
    store_ = std::move(store);
  }

  std::array<LineOfCells, 2> axis_;
  int stride_;
  std::shared_ptr<const BlockFunctions> functions_;  // to which blocks point; copies have the same
  LargeArray<Block> blocks_;
  Slots store_;  // of one block after another
  std::size_t most_slots_ = 0;
  std::size_t end_ = 0;  // of the slots that blocks have reserved
};

}  // namespace mpm::MPM_ISA
