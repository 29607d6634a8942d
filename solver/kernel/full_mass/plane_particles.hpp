#pragma once

#include <array>
#include <span>

#include "solver/kernel/cell_field.hpp"
#include "solver/kernel/cell_stress.hpp"
#include "solver/kernel/full_mass/bands.hpp"
#include "solver/kernel/node_sums.hpp"

namespace mpm::MPM_ISA {

/// Splines in a plane, written as tensor products whatever their degree.
template <int polynomial_degree>
struct PlaneBasis : LaneBasis<polynomial_degree, false> {
  static constexpr bool is_bilinear = false;
};

/// The particles of a plane and the loops over them, each in vectors of `width` cells.
template <int degree>
class PlaneParticles {
 public:
  using Basis = PlaneBasis<degree>;
  using Weights = TensorWeights<Basis>;

  PlaneParticles(const KernelSetup& setup, const Lattice& lattice, const Bands& bands)
      : bands_(bands),
        basis_{{{setup.axis[0].inverse_h, setup.axis[1].inverse_h}, lattice.stride()}},
        rheology_(setup.rheology),
        pressure_(setup.pressure),
        has_pressure_(setup.has_pressure),
        stress_with_pressure_(stress_pass_of<TaitPressure>(rheology_)),
        viscous_stress_(stress_pass_of<NoPressure>(rheology_)),
        rows_{0, setup.axis[1].cells},
        seeded_(setup, lattice.stride()),
        cells_(seeded_) {}

  [[nodiscard]] const Basis& basis() const { return basis_; }
  [[nodiscard]] double cell_size(int axis) const { return 1 / basis_.inverse_h[axis]; }
  [[nodiscard]] bool has_pressure() const { return has_pressure_; }
  [[nodiscard]] Cells& cells() { return cells_; }
  [[nodiscard]] const Cells& cells() const { return cells_; }

  /// All rows of cells.
  [[nodiscard]] Rows rows() const { return rows_; }

  /// Every particle becomes what it was at the start.
  void put_back() { cells_ = seeded_; }

  template <class F>
  [[gnu::always_inline]] void each_block(Rows rows, F&& f) {
    for (const Block& block : cells_.blocks(rows)) f(block);
  }
  /// f(number, slot, weights)
  template <class F>
  [[gnu::always_inline]] void each_slot(const Block& block, F&& f) {
    for (int k = 0; Slot & p : cells_.slots(block)) f(k++, p, Weights(basis_, block, p.s));
  }
  [[nodiscard]] Affine& affine(const Block& block, int k) {
    return cells_.affines(block)[static_cast<std::size_t>(k)];
  }

  /// Adds to nodal fields what the particles give to their nodes: give(block, sums) adds the share of a
  /// block's particles to the sums of its cells.
  template <class Sums, class Give>
  void scatter(const std::array<double*, Sums::fields>& nodes, Give&& give) {
    bands_.each_of_cells_apart([&](Rows rows) {
      NodeSums<Basis, Sums> node_sums(basis_, nodes);
      each_block(rows, [&](const Block& block) {
        Sums sums;
        give(block, sums);
        node_sums.add(block.first_node, sums);
      });
      node_sums.finish();
    });
  }

  /// Stress of the scene's fluid [Pa], of some slots.
  void set_stress(std::span<const Strained> strained, Stress* stress) const {
    if (has_pressure_)
      stress_with_pressure_(rheology_, pressure_, strained, stress);
    else
      viscous_stress_(rheology_, NoPressure{}, strained, stress);
  }

  /// f(law, pressure) of a Newtonian fluid; false of another.
  template <class F>
  bool with_newtonian(F&& f) const {
    const auto* const law = std::get_if<Newtonian>(&rheology_);
    if (law && has_pressure_)
      f(*law, pressure_);
    else if (law)
      f(*law, NoPressure{});
    return law != nullptr;
  }

 private:
  const Bands& bands_;
  Basis basis_;
  Rheology rheology_;
  TaitPressure pressure_;
  bool has_pressure_;
  StressPass<TaitPressure> stress_with_pressure_;
  StressPass<NoPressure> viscous_stress_;
  Rows rows_;
  const Cells seeded_;
  Cells cells_;
};

}  // namespace mpm::MPM_ISA
