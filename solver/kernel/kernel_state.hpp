#pragma once

#include <vector>

#include "solver/kernel/cells/cells.hpp"
#include "solver/kernel/kernel_fluid.hpp"
#include "solver/kernel/nodal_fields.hpp"

namespace mpm::MPM_ISA {

/// Particles, nodes and fluid of a kernel, and what of its passes is the same for every basis.
class KernelState : public Kernel {
 public:
  NodeFields nodes() final {
    const auto v = fields_.velocity(), w = fields_.mapped(), a = fields_.acceleration();
    return {fields_.inverse_mass(), {v[0], v[1]}, {w[0], w[1]}, {a[0], a[1]}};
  }

  Motion settle() final {
    Motion motion;
    for (Share& share : shares_) {
      motion.energy += sum(share.energy);
      motion.dense &= !(share.least_volume < 0).any();
      motion.inside &= cells_.rehouse(share.left);
      share.left.clear();
      share.energy = share.least_volume = 0;
    }
    make_room();
    return motion;
  }

  void gather(PointState* points) const final { cells_.gather(points); }

 protected:
  using Pair = NodalFields::Pair;

  /// What belongs to a share of the cells alone, so that threads need not agree.
  struct alignas(64) Share {
    Lanes energy = 0, least_volume = 0;  // that its particles were found to have
    std::vector<Mover> left;             // particles no longer in their cells
    std::vector<Strained> strained;      // of one block at a time
    std::vector<Stress> stress;          // the same
  };

  /// Of a basis of which `rows_a_cell` functions across the lanes are not zero in a cell; the last of them
  /// lies `last_offset` on from the first.
  KernelState(const KernelSetup& setup, int rows_a_cell, int last_offset)
      : cells_(setup, stride_of(setup)),
        fields_(fields_of(setup, cells_, rows_a_cell, last_offset)),
        fluid_(setup),
        most_inverse_mass_(setup.most_inverse_mass),
        shares_(static_cast<std::size_t>(setup.shares)) {
    make_room();
  }

  /// From a row of cells to the next.
  static int stride_of(const KernelSetup& setup) { return setup.axis[0].cells + setup.degree; }

  [[nodiscard]] Cells& cells() { return cells_; }
  [[nodiscard]] NodalFields& fields() { return fields_; }
  [[nodiscard]] const KernelFluid& fluid() const { return fluid_; }
  [[nodiscard]] Share& share(const Part& part) { return shares_[static_cast<std::size_t>(part.share)]; }
  /// Of slots.
  [[nodiscard]] std::ptrdiff_t bytes_a_cell() const { return bytes_a_cell_; }

  /// Momenta over masses; what was mass becomes its inverse.
  void divide_by_mass(Rows nodes) {
    double* const m_i = fields_.inverse_mass();
    fields_.each_node(nodes, [=, v_i = fields_.velocity()](int i, auto count) {
      const Lanes m = load(m_i + i), one_over_m = select(m > 0, 1 / m, 0);
      store_first(count, m_i + i, one_over_m);
      for (double* v : v_i) store_first(count, v + i, load(v + i) * one_over_m);
    });
  }
  /// Mapped momenta times the inverse of masses.
  void divide_mapped(Rows nodes) {
    fields_.each_node(nodes,
                      [v_i = fields_.mapped(), one_over_m = fields_.inverse_mass()](int i, auto count) {
                        for (double* v : v_i) store_first(count, v + i, load(v + i) * load(one_over_m + i));
                      });
  }

  /// a_i = f_i/m_i + b, v_i += dt a_i.
  void accelerate_nodes(Rows nodes, const double b[2], double dt) {
    const Pair a_i = fields_.acceleration(), v_i = fields_.velocity();
    const double g[2] = {b[0], b[1]};
    const Lanes most = most_inverse_mass_;
    fields_.each_node(nodes, [=, inverse = fields_.inverse_mass()](int i, auto count) {
      const Lanes one_over_m = load(inverse + i), felt = least(one_over_m, most);
      for (std::size_t c : {0, 1}) {
        const Lanes a = select(one_over_m > 0, load(a_i[c] + i) * felt + g[c], 0);
        store_first(count, a_i[c] + i, a);
        store_first(count, v_i[c] + i, load(v_i[c] + i) + dt * a);
      }
    });
  }

 private:
  void make_room() {
    bytes_a_cell_ = cells_.bytes_a_cell();
    for (Share& share : shares_) {
      share.strained.resize(cells_.most_slots());
      share.stress.resize(cells_.most_slots());
    }
  }

  static NodalFields fields_of(const KernelSetup& setup, const Cells& cells, int rows_a_cell,
                               int last_offset) {
    const auto& [along, across] = setup.axis;
    const bool is_periodic_across = across.periodic && !setup.strip;
    const int rows = across.cells + rows_a_cell - 1;
    // Blocks at the end read and write beyond the last node.
    const int size = std::max(rows * cells.stride(), cells.count()) + last_offset + 2 * width;
    return {{along.cells, across.cells},
            {along.periodic, is_periodic_across},
            rows,
            cells.stride(),
            static_cast<std::size_t>(size)};
  }

  Cells cells_;
  NodalFields fields_;
  KernelFluid fluid_;
  double most_inverse_mass_;
  std::vector<Share> shares_;
  std::ptrdiff_t bytes_a_cell_ = 0;
};

}  // namespace mpm::MPM_ISA
