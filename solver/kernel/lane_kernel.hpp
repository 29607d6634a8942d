#pragma once

#include "solver/kernel/cell_dilatation.hpp"
#include "solver/kernel/kernel_state.hpp"
#include "solver/kernel/node_sums.hpp"

namespace mpm::MPM_ISA {

/// The passes over particles and nodes, each particle loop in vectors of `width` cells.
template <class Basis>
class LaneKernel final : public KernelState {
 public:
  explicit LaneKernel(const KernelSetup& setup) : LaneKernel(setup, basis_of(setup)) {}

  /// P2G: m_i = sum_p N_ip m_p, v_i = sum_p N_ip m_p v_p / m_i (paper Eqs. 14-15).
  void map_velocity(const Part& part) override {
    const Pair v_i = fields().velocity();
    sum_momentum<true>(part, {fields().inverse_mass(), v_i[0], v_i[1]});
    divide_by_mass(part.complete);
  }

  void map_updated_velocity(const Part& part) override {
    sum_momentum<false>(part, fields().mapped());
    divide_mapped(part.complete);
  }

  void update_stress(const Part& part, NodalVelocity from, double dt) override {
    const Pair v_i = from == NodalVelocity::Current ? fields().velocity() : fields().mapped();
    fluid().with_stress<false>([&](const auto& pressure, const auto& stress_of) {
      each_block(part.cells, [&](const Block& block) {
        stress_of(strain<no_fetch>(block, part, v_i, dt, pressure), cells().stresses(block).data());
      });
    });
  }

  void accelerate(const Part& part, const double b[2], double dt) override {
    if (fluid().has_cell_pressure())
      accelerate_with_stress<CellTaitPressure>(part);
    else
      accelerate_with_stress<TaitPressure>(part);
    accelerate_nodes(part.complete, b, dt);
  }

  void update_stress_and_accelerate(const Part& part, const double b[2], double dt) override {
    fluid().with_stress<newtonian_is_inlined>(
        [&]<class Pressure>(const Pressure& pressure, const auto& stress_of) {
          Stress* const room = share(part).stress.data();
          scatter<DivergenceSums<Basis>>(part, fields().acceleration(), [&](const Block& block, auto& sums) {
            const auto strained = strain<fetch_by_forces>(block, part, fields().velocity(), dt, pressure);
            sum_forces<no_fetch, Pressure>(block, part, stress_of(strained, room), sums);
          });
        });
    accelerate_nodes(part.complete, b, dt);
  }

  void take(const Part& part, double flip_fraction, double dt) override {
    if (cells().is_affine())
      gather_from_nodes<Take::Affine, false>(part, 0, dt);
    else if (flip_fraction == 1)
      gather_from_nodes<Take::Flip, false>(part, 1, dt);
    else
      gather_from_nodes<Take::Blend, false>(part, flip_fraction, dt);
  }
  void move(const Part& part, double dt) override { gather_from_nodes<Take::Nothing, true>(part, 0, dt); }
  void take_and_move(const Part& part, double flip_fraction, double dt) override {
    if (cells().is_affine())
      gather_from_nodes<Take::Affine, true>(part, 0, dt);
    else if (flip_fraction == 1)
      gather_from_nodes<Take::Flip, true>(part, 1, dt);
    else
      gather_from_nodes<Take::Blend, true>(part, flip_fraction, dt);
  }

 private:
  LaneKernel(const KernelSetup& setup, const Basis& basis)
      : KernelState(setup, Basis::support[1], basis.offset(Basis::nodes - 1)), basis_(basis) {}
  static Basis basis_of(const KernelSetup& setup) {
    return {{setup.axis[0].inverse_h, setup.axis[1].inverse_h}, stride_of(setup)};
  }

  static constexpr bool newtonian_is_inlined = Basis::degree == 1;

  /// Part of a slot, in sixths of its size. The passes of a step share out what has to come from memory as
  /// they share out its time, so that memory is busy all along: the first fetches nodes, the others slots.
  struct Fetch {
    std::size_t first, sixths;
  };
  static constexpr Fetch no_fetch{0, 0}, fetch_by_forces{0, 4}, fetch_by_g2p{4, 2};

  /// Nodal momenta, and masses before them, if asked for.
  template <bool with_mass>
  void sum_momentum(const Part& part, const std::array<double*, with_mass ? 3 : 2>& nodes) {
    const auto sum = [&](const auto& velocity_of) {
      scatter<MomentumSums<Basis, with_mass>>(part, nodes, [&](const Block& block, auto& sums) {
        if (with_mass && part.ahead > 0) fields().fetch(block.first_node + part.ahead);
        each_slot<no_fetch>(block, part, [&](int k, const Slot& p, const auto& n_p) {
          sums.add(n_p, p.mass, velocity_of(block, k, p, n_p));
        });
      });
    };
    if (cells().is_affine())
      sum([&]<class Weights>(const Block& block, int k, const Slot& p, const Weights&) {
        return AffineVelocity<Basis, Weights::is_uniform>(
            block, p, cells().affines(block)[static_cast<std::size_t>(k)]);
      });
    else
      sum([](const Block&, int, const Slot& p, const auto&) -> const auto& { return p.v; });
  }

  /// Strain rates of a block's slots from the nodal velocity, volumes V (1 + dt tr D).
  template <Fetch fetch, class Pressure>
  std::span<const Strained> strain(const Block& block, const Part& part, const Pair& v_i, double dt,
                                   [[maybe_unused]] const Pressure& pressure) {
    Share& of_part = share(part);
    Strained* const strained = of_part.strained.data();
    const CellVelocityGradient<Basis> grad_v(basis_, block, v_i);
    Lanes least_volume = 0;
    [[maybe_unused]] CellStrain of_cell{0, 0};
    if constexpr (Pressure::is_of_cell)
      of_cell = strain_cells(basis_, block, cells().slots(block), grad_v, dt, pressure, least_volume);
    const auto strain_slot = [&](int k, Slot& p, const auto& n_p) {
      const auto [d_00, d_01] = grad_v[0].at(n_p);
      const auto [d_10, d_11] = grad_v[1].at(n_p);
      strained[k] = {d_00, d_11, d_01 + d_10, 0};
      if constexpr (Pressure::is_of_cell) {
        const Lanes excess = 0.5 * (of_cell.dilatation - (d_00 + d_11));
        strained[k] = {d_00 + excess, d_11 + excess, d_01 + d_10, of_cell.density};
      } else if constexpr (Pressure::varies) {
        p.volume = p.volume * (1 + dt * (d_00 + d_11));
        strained[k].density = p.mass / select(p.mass > 0, p.volume, 1);
        least_volume = least(least_volume, p.volume);
      }
    };
    each_slot<fetch>(block, part, strain_slot);
    of_part.least_volume = least(of_part.least_volume, least_volume);
    return {strained, cells().slots(block).size()};
  }

  /// What the slots of a block give to the nodes of their cells: -V_p sigma_p grad N_ip is a particle's share
  /// of f_i (paper Eq. 17); V_p = m_p/rho_p. stress_at(k, factor): of the k-th slot, times a factor.
  template <Fetch fetch, class Pressure, class StressAt>
  void sum_forces(const Block& block, const Part& part, const StressAt& stress_at,
                  DivergenceSums<Basis>& sums) {
    CellForces<Basis, Pressure> forces{sums};
    each_slot<fetch>(block, part, [&](int k, const Slot& p, const auto& n_p) {
      forces.add(n_p, stress_at(static_cast<std::size_t>(k), 0 - p.volume));
    });
    forces.finish(basis_, block);
  }

  /// f_i of the stress that the particles have.
  template <class Pressure>
  void accelerate_with_stress(const Part& part) {
    scatter<DivergenceSums<Basis>>(part, fields().acceleration(), [&](const Block& block, auto& sums) {
      const auto stress_at = [stress = cells().stresses(block).data()](std::size_t k, Lanes factor) {
        return factor * stress[k];
      };
      sum_forces<fetch_by_forces, Pressure>(block, part, stress_at, sums);
    });
  }

  enum class Take { Nothing, Flip, Blend, Affine };

  /// G2P: v_p = flip (v_p + dt a(x_p)) + (1 - flip) v(x_p); x_p += dt v(x_p) (paper Eqs. 18-20). Affine: v_p
  /// = v(x_p), and C_p.
  template <Take taken, bool moves>
  void gather_from_nodes(const Part& part, [[maybe_unused]] double flip, double dt) {
    Share& of_part = share(part);
    const double cells_a_step[2] = {dt * basis_.inverse_h[0], dt * basis_.inverse_h[1]};
    each_block(part.cells, [&](const Block& block) {
      const CellVelocity<Basis> v(basis_, block, fields().velocity());
      const CellVelocity<Basis> a(basis_, block, fields().acceleration());
      Lanes energy = 0, lowest = 0, highest = 0;
      const auto take = [&]<class Weights>([[maybe_unused]] int k, Slot& p, const Weights& n_p) {
        if constexpr (taken == Take::Affine) {
          const CellMoments<Basis, Weights::is_uniform> m_p(basis_, block, p, n_p);
          Affine& affine = cells().affines(block)[static_cast<std::size_t>(k)];
          for (int c : {0, 1}) {
            const auto u = v[c].affinely_at(n_p, m_p);
            p.v[c] = u.value;
            for (int axis : {0, 1}) affine.c[c][axis] = u.change[axis];
          }
        }
        for (int c : {0, 1}) {
          if constexpr (taken == Take::Flip) p.v[c] += dt * a[c].at(n_p);
          if constexpr (taken == Take::Blend)
            p.v[c] = flip * (p.v[c] + dt * a[c].at(n_p)) + (1 - flip) * v[c].at(n_p);
        }
        energy += p.v[0] * p.v[0] + p.v[1] * p.v[1];
      };
      const auto move = [&](int, Slot& p, const auto& n_p) {
        for (int c : {0, 1}) {
          const Lanes of_grid = taken == Take::Affine ? p.v[c] : v[c].at(n_p);
          p.s[c] = select(p.mass > 0, p.s[c] + cells_a_step[c] * of_grid, p.s[c]);
          lowest = least(lowest, p.s[c]);
          highest = largest(highest, p.s[c]);
        }
      };
      if constexpr (taken == Take::Nothing)
        each_slot<no_fetch>(block, part, move);
      else if constexpr (!moves)
        each_slot<fetch_by_g2p>(block, part, take);
      else
        each_slot<fetch_by_g2p>(block, part, take, move);
      of_part.energy += energy;
      if (((lowest < 0) | (highest >= 1)).any()) cells().take_out_movers(block, of_part.left);
    });
  }

  /// Sums what the particles of a part give to nodes, those of their cells: give(block, sums) adds the share
  /// of a block's particles to the sums of its cells.
  template <class Sums, class Give>
  [[gnu::flatten]] void scatter(const Part& part, const std::array<double*, Sums::fields>& nodes,
                                Give&& give) {
    for (double* node : nodes) fields().clear(node, part.fresh);
    NodeSums<Basis, Sums> node_sums(basis_, nodes);
    for (const Block& block : cells().blocks(part.cells)) {
      Sums sums;
      give(block, sums);
      node_sums.add(block.first_node, sums);
    }
    node_sums.finish();
    for (double* node : nodes) fields().join_images(node, part.complete);
  }

  /// f(block) for the cells of some rows.
  template <class F>
  [[gnu::flatten]] void each_block(Rows rows, F&& f) {
    for (const Block& block : cells().blocks(rows)) f(block);
  }

  /// f(number, slot, weights) for the slots of a block. Meanwhile `fetch` of what is stored part.ahead cells
  /// on is brought into the cache.
  template <Fetch fetch, class F>
  void each_slot(const Block& block, const Part& part, F&& f) {
    [[maybe_unused]] constexpr std::size_t sixth = sizeof(Slot) / 6,
                                           end = (fetch.first + fetch.sixths) * sixth;
    [[maybe_unused]] const std::ptrdiff_t ahead = part.ahead * bytes_a_cell();
    with_weights(basis_, block, [&](const auto& weights) {
      for (int k = 0; Slot & p : cells().slots(block)) {
        if constexpr (fetch.sixths > 0)
          if (ahead > 0)
            for (std::size_t byte = fetch.first * sixth; byte < end; byte += 64)
              fetch_ahead(reinterpret_cast<const char*>(&p) + ahead + byte);
        f(k++, p, weights(p.s));
      }
    });
  }

  /// `first` of every slot, and `second`. The weights of the bilinear basis are nothing but places in the
  /// cell: two short loops keep all that they need in registers, and what ends one slot does not hold up the
  /// next. Other weights are worth keeping.
  template <Fetch fetch, class First, class Second>
  void each_slot(const Block& block, const Part& part, First&& first, Second&& second) {
    if constexpr (Basis::is_bilinear) {
      each_slot<fetch>(block, part, first);
      each_slot<no_fetch>(block, part, second);
    } else {
      each_slot<fetch>(block, part, [&](int k, Slot& p, const auto& n_p) {
        first(k, p, n_p);
        second(k, p, n_p);
      });
    }
  }

  Basis basis_;
};

}  // namespace mpm::MPM_ISA
