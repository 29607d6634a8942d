#pragma once

#include <variant>

#include "solver/kernel/scatter.hpp"

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
        team_(setup.team),
        chunks_(cells_.count(), basis_.offset(Basis::nodes - 1)),
        found_(static_cast<std::size_t>(chunks_.count)) {
    // Blocks at the end read and write beyond the last node, within a margin.
    const int size =
        std::max(rows_ * cells_.stride(), chunks_.cells) + basis_.offset(Basis::nodes - 1) + margin;
    for (auto& field : fields_) field.assign(static_cast<std::size_t>(size / width + 1), Lanes(0));
  }

  NodeFields nodes() override {
    const auto at = [&](int f) { return field(f); };
    return {cells_.stride(),
            rows_,
            at(mass),
            {at(velocity), at(velocity + 1)},
            {at(mapped), at(mapped + 1)},
            {at(force), at(force + 1)},
            {at(acceleration), at(acceleration + 1)}};
  }

  /// m_i = sum_p N_ip m_p, v_i = sum_p N_ip m_p v_p / m_i (paper Eqs. 14-15).
  void map_velocity(NodalVelocity to) override {
    double* const v_i[2] = {velocity_field(to)[0], velocity_field(to)[1]};
    scatter<3>({field(mass), v_i[0], v_i[1]}, [&](const Block&) {
      return [](int, const Slot& p, const CellWeights<Basis>& n_p, auto& sum) {
        n_p.values([&](int i, Lanes n) {
          const Lanes n_m = n * p.mass;
          sum[0][i] += n_m;
          sum[1][i] += n_m * p.v[0];
          sum[2][i] += n_m * p.v[1];
        });
      };
    });
    each_node([=, m_i = field(mass), inverse = field(inverse_mass)](int i) {
      const Lanes m = load(m_i + i), one_over_m = select(m > 0, 1 / m, 0);
      store(inverse + i, one_over_m);
      for (int c : {0, 1}) store(v_i[c] + i, load(v_i[c] + i) * one_over_m);
    });
  }

  void update_stress(NodalVelocity from, double dt) override {
    with_fluid([&](const auto& law, const auto& pressure) {
      each_block([&](const Block& block, Found&) {
        const NodesOfCells<Basis> v(basis_, block, velocity_field(from).data());
        const auto stress = cells_.stresses(block).begin();
        for (int k = 0; Slot & p : cells_.slots(block))
          stress[k++] = stress_of(p, CellWeights<Basis>(basis_, block, p.x), v, law, pressure, dt);
      });
    });
  }

  void forces() override {
    scatter<2>({field(force), field(force + 1)}, [&](const Block& block) {
      return [stress = cells_.stresses(block).begin()](int k, const Slot& p, const CellWeights<Basis>& n_p,
                                                       auto& sum) { add_force(p, stress[k], n_p, sum); };
    });
  }

  void update_stress_and_forces(double dt) override {
    with_fluid([&](const auto& law, const auto& pressure) {
      scatter<2>({field(force), field(force + 1)}, [&](const Block& block) {
        const NodesOfCells<Basis> v(basis_, block, velocity_field(NodalVelocity::Current).data());
        return [=, &law, &pressure](int, Slot& p, const CellWeights<Basis>& n_p, auto& sum) {
          add_force(p, stress_of(p, n_p, v, law, pressure, dt), n_p, sum);
        };
      });
    });
  }

  void accelerate(const double b[2], double dt) override {
    double* const f_i[2] = {field(force), field(force + 1)};
    double* const a_i[2] = {field(acceleration), field(acceleration + 1)};
    double* const v_i[2] = {field(velocity), field(velocity + 1)};
    const double b_0 = b[0], b_1 = b[1];
    each_node([=, inverse = field(inverse_mass)](int i) {
      const Lanes one_over_m = load(inverse + i), g[2] = {b_0, b_1};
      for (int c : {0, 1}) {
        const Lanes a = select(one_over_m > 0, load(f_i[c] + i) * one_over_m + g[c], 0);
        store(a_i[c] + i, a);
        store(v_i[c] + i, load(v_i[c] + i) + dt * a);
      }
    });
  }

  void take(double flip_fraction, double dt) override { gather_from_nodes<true, false>(flip_fraction, dt); }
  Motion move(double dt) override { return gather_from_nodes<false, true>(0, dt); }
  Motion take_and_move(double flip_fraction, double dt) override {
    return gather_from_nodes<true, true>(flip_fraction, dt);
  }

  void gather(PointState* points) const override { cells_.gather(points); }

 private:
  enum {
    mass,
    inverse_mass,  // zero where there is no mass
    velocity,
    mapped = velocity + 2,
    force = mapped + 2,
    acceleration = force + 2,
    field_count = acceleration + 2
  };

  /// What a chunk of cells reports when its particles have moved.
  struct alignas(64) Found {
    Lanes energy, least_volume;
    std::vector<Address> left;
  };

  [[nodiscard]] double* field(int f) { return reinterpret_cast<double*>(fields_[f].data()); }
  [[nodiscard]] std::array<double*, 2> velocity_field(NodalVelocity which) {
    const int f = which == NodalVelocity::Current ? velocity : mapped;
    return {field(f), field(f + 1)};
  }

  /// D from the nodal velocity; volume V (1 + dt tr D), density m/V; sigma = 2 mu D - (2/3 mu tr D + P) I
  /// (paper Eqs. 21 to 25).
  template <class Law, class Pressure>
  static Stress stress_of(Slot& p, const CellWeights<Basis>& n_p, const NodesOfCells<Basis>& v,
                          const Law& law, const Pressure& pressure, double dt) {
    Lanes d_00 = 0, d_11 = 0, d_01 = 0, d_10 = 0;
    n_p.gradients([&](int i, Lanes dn_0, Lanes dn_1) {
      d_00 += v.at[0][i] * dn_0;
      d_01 += v.at[0][i] * dn_1;
      d_10 += v.at[1][i] * dn_0;
      d_11 += v.at[1][i] * dn_1;
    });
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

  /// f_i -= V_p sigma_p grad N_ip, V_p = m_p/rho_p (paper Eq. 17)
  template <class Sum>
  static void add_force(const Slot& p, const Stress& s, const CellWeights<Basis>& n_p, Sum& sum) {
    const Lanes s_00 = p.volume * s.s_00, s_11 = p.volume * s.s_11, s_01 = p.volume * s.s_01;
    n_p.gradients([&](int i, Lanes dn_0, Lanes dn_1) {
      sum[0][i] -= s_00 * dn_0 + s_01 * dn_1;
      sum[1][i] -= s_01 * dn_0 + s_11 * dn_1;
    });
  }

  /// G2P: v_p = flip (v_p + dt a(x_p)) + (1 - flip) v(x_p); x_p += dt v(x_p) (paper Eqs. 18-20).
  template <bool takes, bool moves>
  Motion gather_from_nodes(double flip, double dt) {
    each_block([=, this](const Block& block, Found& found) {
      const NodesOfCells<Basis> v(basis_, block, velocity_field(NodalVelocity::Current).data());
      double* const a_i[2] = {field(acceleration), field(acceleration + 1)};
      const NodesOfCells<Basis> a(basis_, block, a_i);
      Lanes energy = 0, least_volume = 0, lowest = 0, highest = 0;
      for (Slot& p : cells_.slots(block)) {
        Lanes v_x[2] = {0, 0}, a_x[2] = {0, 0};
        CellWeights<Basis>(basis_, block, p.x).values([&](int i, Lanes n) {
          for (int c : {0, 1}) v_x[c] += n * v.at[c][i];
          if constexpr (takes)
            for (int c : {0, 1}) a_x[c] += n * a.at[c][i];
        });
        if constexpr (takes)
          for (int c : {0, 1}) p.v[c] = flip * (p.v[c] + dt * a_x[c]) + (1 - flip) * v_x[c];
        if constexpr (moves) {
          for (int c : {0, 1}) {
            p.x[c] = select(p.mass > 0, p.x[c] + dt * v_x[c], p.x[c]);
            const Lanes s = p.x[c] * basis_.inverse_h[c] - block.cell[c];
            lowest = least(lowest, s);
            highest = largest(highest, s);
          }
          energy += p.mass * (p.v[0] * p.v[0] + p.v[1] * p.v[1]);
          least_volume = least(least_volume, p.volume);
        }
      }
      if constexpr (moves) {
        found.energy += energy;
        found.least_volume = least(found.least_volume, least_volume);
        if ((lowest < 0).any() || (highest >= 1).any()) list_movers(block, found.left);
      }
    });
    return moves ? settle() : Motion{};
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

  /// Gives the particles that left their cells new places and sums up what the chunks found.
  Motion settle() {
    Motion motion;
    for (Found& found : found_) {
      motion.energy += sum(found.energy);
      motion.dense &= !(found.least_volume < 0).any();
      motion.inside &= cells_.rehouse(found.left);
      found.left.clear();
    }
    return motion;
  }

  /// Sums what particles give to the nodes of their cells: give(block) returns what a slot adds to its cells'
  /// sums, (number of the slot, slot, weights, sum[field][node]).
  template <int fields, class Give>
  void scatter(double* const (&nodes)[fields], Give&& give) {
    for (double* node : nodes) each_node([=](int i) { store(node + i, 0); });
    chunks_.each_in_two_turns(team_, [&](int chunk) {
      TileSums<Basis, fields> sums;
      for (int first = chunks_.begin(chunk); first < chunks_.end(chunk); first += tile) {
        const int cells = std::min(tile, chunks_.end(chunk) - first);
        for (int cell = 0; cell < cells; cell += width) {
          const Block& block = cells_.block(first + cell);
          Lanes sum[fields][Basis::nodes];
          for (auto& row : sum) unroll<Basis::nodes>([&](int i) { row[i] = 0; });
          const auto add = give(block);
          for (int k = 0; Slot & p : cells_.slots(block))
            add(k++, p, CellWeights<Basis>(basis_, block, p.x), sum);
          sums.put(cell, sum);
        }
        sums.add_to(nodes, basis_, first, cells);
      }
    });
    for (double* node : nodes) join_images(node);
  }

  /// f(block, what its chunk found) for all blocks.
  template <class F>
  void each_block(F&& f) {
    chunks_.each(team_, [&](int chunk) {
      Found& found = found_[static_cast<std::size_t>(chunk)];
      found.energy = 0;
      found.least_volume = 0;
      for (int cell = chunks_.begin(chunk); cell < chunks_.end(chunk); cell += width)
        f(cells_.block(cell), found);
    });
  }

  /// f(i) for the nodes i to i + width - 1, until all are done.
  template <class F>
  void each_node(F&& f) {
    const int size = rows_ * cells_.stride();
    chunks_.each(team_, [&](int chunk) {
      const int end = chunk + 1 == chunks_.count ? size : std::min(size, chunks_.end(chunk));
      for (int i = chunks_.begin(chunk); i < end; i += width) f(i);
    });
  }

  /// Adds up the shares of a periodic node's images, and gives all of them the sum.
  void join_images(double* node) const {
    const int stride = cells_.stride();
    if (periodic_[0])
      for (int row = 0; row < rows_ * stride; row += stride) join_line(node + row, 1, count_[0]);
    if (periodic_[1])
      for (int i = 0; i < stride; ++i) join_line(node + i, stride, count_[1]);
  }
  static void join_line(double* node, int step, int count) {
    for (int k = count; k < count + Basis::degree; ++k) node[k % count * step] += node[k * step];
    for (int k = count; k < count + Basis::degree; ++k) node[k * step] = node[k % count * step];
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
  ThreadTeam* team_;
  Chunks chunks_;
  std::vector<Found> found_;
  LargeArray<Lanes> fields_[field_count];
};

}  // namespace mpm::MPM_ISA
