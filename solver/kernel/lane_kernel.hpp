#pragma once

#include <variant>

#include "solver/kernel/tile_sums.hpp"

namespace mpm::MPM_ISA {

/// The passes over particles and nodes, each particle loop in vectors of `width` cells.
template <class Basis>
class LaneKernel final : public Kernel {
 public:
  explicit LaneKernel(const KernelSetup& setup)
      : cells_(setup),
        basis_{{setup.axis[0].inverse_h, setup.axis[1].inverse_h}, cells_.stride()},
        periodic_{setup.axis[0].periodic, setup.axis[1].periodic && !setup.strip},
        count_{setup.axis[0].cells, setup.axis[1].cells},
        rows_(setup.axis[1].cells + Basis::support[1] - 1),
        rheology_(setup.rheology),
        pressure_(setup.pressure),
        has_pressure_(setup.has_pressure),
        found_(static_cast<std::size_t>(setup.shares)) {
    // Blocks at the end read and write beyond the last node, within a margin. Fields begin some cache lines
    // apart modulo a page: at the same place in their pages they would compete for the same lines of the
    // cache.
    constexpr std::size_t page = 4096 / sizeof(double), apart = 9 * 64 / sizeof(double);
    const auto size = static_cast<std::size_t>(std::max(rows_ * cells_.stride(), cells_.count()) +
                                               basis_.offset(Basis::nodes - 1) + 2 * margin);
    field_size_ = (size + page - 1) / page * page + apart;
    fields_.assign(field_count * field_size_ / static_cast<std::size_t>(width), Lanes(0));
  }

  NodeFields nodes() override {
    const auto at = [&](int f) { return field(f); };
    return {at(inverse_mass),
            {at(velocity), at(velocity + 1)},
            {at(mapped), at(mapped + 1)},
            {at(acceleration), at(acceleration + 1)}};
  }

  /// P2G: m_i = sum_p N_ip m_p, v_i = sum_p N_ip m_p v_p / m_i (paper Eqs. 14-15).
  void map_velocity(const Part& part) override {
    double* const m_i = field(inverse_mass);
    const auto v_i = pair(velocity);
    scatter<MomentumSums<Basis, true>, fetch_by_p2g>(part, {m_i, v_i[0], v_i[1]}, give_momentum);
    each_node(part.complete, [=](int i, auto count) {
      const Lanes m = load(m_i + i), one_over_m = select(m > 0, 1 / m, 0);
      store_first(count, m_i + i, one_over_m);
      for (int c : {0, 1}) store_first(count, v_i[c] + i, load(v_i[c] + i) * one_over_m);
    });
  }

  void map_updated_velocity(const Part& part) override {
    const auto v_i = pair(mapped);
    scatter<MomentumSums<Basis, false>, no_fetch>(part, v_i, give_momentum);
    each_node(part.complete, [=, one_over_m = field(inverse_mass)](int i, auto count) {
      for (int c : {0, 1}) store_first(count, v_i[c] + i, load(v_i[c] + i) * load(one_over_m + i));
    });
  }

  void update_stress(const Part& part, NodalVelocity from, double dt) override {
    with_fluid([&](const auto& law, const auto& pressure) {
      each_block(part.cells, [&](const Block& block) {
        const CellVelocity<Basis> v(basis_, block, pair(from == NodalVelocity::Current ? velocity : mapped));
        const auto stress = cells_.stresses(block).begin();
        each_slot<no_fetch>(block, part, [&](int k, Slot& p, const CellWeights<Basis>& n_p) {
          stress[k] = stress_of(p, n_p, v, law, pressure, dt);
        });
      });
    });
  }

  void accelerate(const Part& part, const double b[2], double dt) override {
    scatter<DivergenceSums<Basis>, fetch_by_forces>(part, pair(acceleration), [&](const Block& block) {
      return [stress = cells_.stresses(block).begin()](int k, const Slot& p, const CellWeights<Basis>& n_p,
                                                       auto& sums) { sums.add(n_p, force_of(p, stress[k])); };
    });
    accelerate_nodes(part.complete, b, dt);
  }

  void update_stress_and_accelerate(const Part& part, const double b[2], double dt) override {
    with_fluid([&](const auto& law, const auto& pressure) {
      scatter<DivergenceSums<Basis>, fetch_by_forces>(part, pair(acceleration), [&](const Block& block) {
        const CellVelocity<Basis> v(basis_, block, pair(velocity));
        return [=, &law, &pressure](int, Slot& p, const CellWeights<Basis>& n_p, auto& sums) {
          sums.add(n_p, force_of(p, stress_of(p, n_p, v, law, pressure, dt)));
        };
      });
    });
    accelerate_nodes(part.complete, b, dt);
  }

  void take(const Part& part, double flip_fraction, double dt) override {
    if (flip_fraction == 1)
      gather_from_nodes<Take::Flip, false>(part, 1, dt);
    else
      gather_from_nodes<Take::Blend, false>(part, flip_fraction, dt);
  }
  void move(const Part& part, double dt) override { gather_from_nodes<Take::Nothing, true>(part, 0, dt); }
  void take_and_move(const Part& part, double flip_fraction, double dt) override {
    if (flip_fraction == 1)
      gather_from_nodes<Take::Flip, true>(part, 1, dt);
    else
      gather_from_nodes<Take::Blend, true>(part, flip_fraction, dt);
  }

  Motion settle() override {
    Motion motion;
    for (Found& found : found_) {
      motion.energy += sum(found.energy);
      motion.dense &= !(found.least_volume < 0).any();
      motion.inside &= cells_.rehouse(found.left);
      found.left.clear();
      found.energy = found.least_volume = 0;
    }
    return motion;
  }

  void gather(PointState* points) const override { cells_.gather(points); }

 private:
  enum {
    inverse_mass,  // mass until a part is complete; zero where there is none
    velocity,
    mapped = velocity + 2,
    acceleration = mapped + 2,  // force until a part is complete
    field_count = acceleration + 2
  };

  /// Part of a slot, in sixths of its size. The passes of a step share a slot out as they share out its time,
  /// so that memory is busy all along.
  struct Fetch {
    std::size_t first, sixths;
  };
  static constexpr Fetch no_fetch{0, 0}, fetch_by_p2g{0, 1}, fetch_by_forces{1, 3}, fetch_by_g2p{4, 2};

  /// What a share of the cells reports when its particles have moved.
  struct alignas(64) Found {
    Lanes energy = 0, least_volume = 0;
    std::vector<Address> left;
  };

  [[nodiscard]] double* field(int f) {
    return reinterpret_cast<double*>(fields_.data()) + static_cast<std::size_t>(f) * field_size_;
  }
  [[nodiscard]] std::array<double*, 2> pair(int f) { return {field(f), field(f + 1)}; }

  /// What every slot gives in P2G: see scatter().
  static constexpr auto give_momentum = [](const Block&) {
    return [](int, const Slot& p, const CellWeights<Basis>& n_p, auto& sums) { sums.add(n_p, p.mass, p.v); };
  };

  /// D from the nodal velocity; volume V (1 + dt tr D), density m/V; sigma = 2 mu D - (2/3 mu tr D + P) I
  /// (paper Eqs. 21 to 25).
  template <class Law, class Pressure>
  static Stress stress_of(Slot& p, const CellWeights<Basis>& n_p, const CellVelocity<Basis>& v,
                          const Law& law, const Pressure& pressure, double dt) {
    const auto [d_00, d_01] = v[0].gradient(n_p);
    const auto [d_10, d_11] = v[1].gradient(n_p);
    const Lanes shear = 0.5 * (d_01 + d_10), dilatation = d_00 + d_11;
    Lanes mu;
    if constexpr (Law::needs_shear_rate)
      mu = law.viscosity(2 * (d_00 * d_00 + d_11 * d_11) + 4 * (shear * shear));
    else
      mu = law.viscosity();
    Lanes isotropic = -(2.0 / 3.0) * mu * dilatation;
    if constexpr (Pressure::varies) {
      p.volume = p.volume * (1 + dt * dilatation);
      isotropic = isotropic - pressure.pressure(p.mass / select(p.mass > 0, p.volume, 1));
    }
    return {2 * mu * d_00 + isotropic, 2 * mu * d_11 + isotropic, 2 * mu * shear};
  }

  /// -V_p sigma_p, which times grad N_ip is the particle's share of f_i (paper Eq. 17); V_p = m_p/rho_p.
  static Stress force_of(const Slot& p, const Stress& s) {
    const Lanes minus_volume = 0 - p.volume;
    return {minus_volume * s.s_00, minus_volume * s.s_11, minus_volume * s.s_01};
  }

  /// a_i = f_i/m_i + b, v_i += dt a_i.
  void accelerate_nodes(Rows nodes, const double b[2], double dt) {
    const auto a_i = pair(acceleration), v_i = pair(velocity);
    const double g[2] = {b[0], b[1]};
    each_node(nodes, [=, inverse = field(inverse_mass)](int i, auto count) {
      const Lanes one_over_m = load(inverse + i);
      for (int c : {0, 1}) {
        const Lanes a = select(one_over_m > 0, load(a_i[c] + i) * one_over_m + g[c], 0);
        store_first(count, a_i[c] + i, a);
        store_first(count, v_i[c] + i, load(v_i[c] + i) + dt * a);
      }
    });
  }

  enum class Take { Nothing, Flip, Blend };

  /// G2P: v_p = flip (v_p + dt a(x_p)) + (1 - flip) v(x_p); x_p += dt v(x_p) (paper Eqs. 18-20).
  template <Take taken, bool moves>
  void gather_from_nodes(const Part& part, [[maybe_unused]] double flip, double dt) {
    Found& found = found_[static_cast<std::size_t>(part.share)];
    each_block(part.cells, [&](const Block& block) {
      const CellVelocity<Basis> v(basis_, block, pair(velocity));
      const CellVelocity<Basis> a(basis_, block, pair(acceleration));
      Lanes energy = 0, least_volume = 0, lowest = 0, highest = 0;
      const CellFrame<Basis> cells(basis_, block);
      each_slot<taken == Take::Nothing ? no_fetch : fetch_by_g2p>(
          block, part, [&](int, Slot& p, const CellWeights<Basis>& n_p) {
            const Lanes v_x[2] = {v[0].value(n_p), v[1].value(n_p)};
            for (int c : {0, 1}) {
              if constexpr (taken == Take::Flip) p.v[c] += dt * a[c].value(n_p);
              if constexpr (taken == Take::Blend)
                p.v[c] = flip * (p.v[c] + dt * a[c].value(n_p)) + (1 - flip) * v_x[c];
            }
            if constexpr (moves) {
              for (int c : {0, 1}) {
                p.x[c] = select(p.mass > 0, p.x[c] + dt * v_x[c], p.x[c]);
                const Lanes s = cells.place(p.x[c], c);
                lowest = least(lowest, s);
                highest = largest(highest, s);
              }
              energy += p.mass * (p.v[0] * p.v[0] + p.v[1] * p.v[1]);
              least_volume = least(least_volume, p.volume);
            }
          });
      if constexpr (moves) {
        found.energy += energy;
        found.least_volume = least(found.least_volume, least_volume);
        if ((lowest < 0).any() || (highest >= 1).any()) list_movers(block, found.left);
      }
    });
  }

  /// Adds the particles of a block that are no longer in their cells to a list.
  [[gnu::noinline]] void list_movers(const Block& block, std::vector<Address>& list) const {
    for (int lane = 0; lane < width; ++lane)
      for (int k = 0; k < block.count[lane]; ++k) {
        bool stays = true;
        for (int c : {0, 1}) {
          const double s = cells_.slots(block)[static_cast<std::size_t>(k)].x[c][lane] * basis_.inverse_h[c] -
                           block.cell[c][lane];
          stays &= s >= 0 && s < 1;
        }
        if (!stays) list.push_back({block.first_node / width, lane, k});
      }
  }

  /// Sums what the particles of a part give to nodes, those of their cells: give(block) returns what adds a
  /// slot's share to its cells' sums, (number of the slot, slot, weights, sums).
  template <class Sums, Fetch fetch, class Give>
  [[gnu::flatten]] void scatter(const Part& part, const std::array<double*, Sums::fields>& nodes,
                                Give&& give) {
    for (double* node : nodes)
      std::fill(node + part.fresh.begin * cells_.stride(), node + part.fresh.end * cells_.stride(), 0.0);
    TileSums<Basis, Sums> tile_sums;
    const int end = cells_.first_of_row(part.cells.end);
    for (int first = cells_.first_of_row(part.cells.begin); first < end; first += tile) {
      const int cells = std::min(tile, end - first);
      for (int cell = 0; cell < cells; cell += width) {
        const Block& block = cells_.block(first + cell);
        Sums sums;
        each_slot<fetch>(block, part, [&, add = give(block)](int k, Slot& p, const CellWeights<Basis>& n_p) {
          add(k, p, n_p, sums);
        });
        tile_sums.put(basis_, cell, sums);
      }
      tile_sums.add_to(nodes, basis_, first, cells);
    }
    for (double* node : nodes) join_images(node, part.complete);
  }

  /// f(block) for the cells of some rows.
  template <class F>
  [[gnu::flatten]] void each_block(Rows rows, F&& f) {
    const int end = cells_.first_of_row(rows.end);
    for (int cell = cells_.first_of_row(rows.begin); cell < end; cell += width) f(cells_.block(cell));
  }

  /// f(number, slot, weights) for the slots of a block. Meanwhile `fetch` of each slot of the block that lies
  /// part.ahead cells on is brought into the cache.
  template <Fetch fetch, class F>
  void each_slot(const Block& block, const Part& part, F&& f) {
    constexpr std::size_t sixth = sizeof(Slot) / 6, end = (fetch.first + fetch.sixths) * sixth;
    const CellFrame<Basis> cells(basis_, block);
    const bool fetches = fetch.sixths > 0 && part.ahead > 0;
    const char* ahead =
        reinterpret_cast<const char*>(fetches ? cells_.address_of(block.first_node + part.ahead) : nullptr);
    for (int k = 0; Slot & p : cells_.slots(block)) {
      if (ahead) {
        for (std::size_t byte = fetch.first * sixth; byte < end; byte += 64)
          __builtin_prefetch(ahead + byte, 0, 2);
        ahead += sizeof(Slot);
      }
      f(k++, p, CellWeights<Basis>(cells, p.x));
    }
  }

  /// f(i, count) for the nodes i to i + count - 1, until those of all the rows are done; count is `width`, a
  /// constant, but at the end.
  template <class F>
  void each_node(Rows rows, F&& f) {
    const int end = rows.end * cells_.stride();
    int i = rows.begin * cells_.stride();
    for (; i + width <= end; i += width) f(i, std::integral_constant<int, width>());
    if (i < end) f(i, end - i);
  }

  /// Adds up the shares of periodic nodes and their images, and gives all of them the sum. Images across the
  /// lanes are complete when their nodes are.
  void join_images(double* node, Rows rows) const {
    const int stride = cells_.stride(), along = count_[0], across = periodic_[1] ? count_[1] : rows_;
    for (int row = rows.begin; row < std::min(rows.end, across); ++row) {
      double* const here = node + row * stride;
      for (int image = row + across; image < rows_; image += across)
        for (int i = 0; i < stride; ++i) here[i] += node[image * stride + i];
      if (periodic_[0]) {
        for (int k = along; k < stride; ++k) here[k % along] += here[k];
        for (int k = along; k < stride; ++k) here[k] = here[k % along];
      }
      for (int image = row + across; image < rows_; image += across)
        std::copy_n(here, stride, node + image * stride);
    }
  }

  /// f(law, pressure) with the scene's own: which they are is asked once a pass, not once a particle.
  template <class F>
  void with_fluid(F&& f) const {
    std::visit(
        [&](const auto& law) {
          if (has_pressure_)
            f(law, pressure_);
          else
            f(law, NoPressure{});
        },
        rheology_);
  }

  Cells cells_;
  Basis basis_;
  bool periodic_[2];
  int count_[2], rows_;
  Rheology rheology_;
  TaitPressure pressure_;
  bool has_pressure_;
  std::vector<Found> found_;
  std::size_t field_size_;    // from one field to the next
  LargeArray<Lanes> fields_;  // one after another
};

}  // namespace mpm::MPM_ISA
