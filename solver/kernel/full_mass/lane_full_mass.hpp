#pragma once

#include <optional>
#include <variant>

#include "solver/kernel/cell_field.hpp"
#include "solver/kernel/cell_stress.hpp"
#include "solver/kernel/full_mass/mass_solve.hpp"
#include "solver/kernel/node_sums.hpp"

namespace mpm::MPM_ISA {

/// Splines in a plane, written as tensor products whatever their degree.
template <int polynomial_degree>
struct PlaneBasis : LaneBasis<polynomial_degree, false> {
  static constexpr bool is_bilinear = false;
};

/// The passes of particles with the consistent mass, in vectors of `width` cells or nodes.
template <int degree>
class LaneFullMass final : public FullMassKernel {
 public:
  explicit LaneFullMass(const FullMassSetup& setup)
      : lattice_(setup.particles.axis, degree),
        basis_{{{setup.particles.axis[0].inverse_h, setup.particles.axis[1].inverse_h}, lattice_.stride()}},
        setup_(setup.particles),
        solve_(lattice_, setup),
        mass_(lattice_),
        right_side_(lattice_),
        velocity_(lattice_),
        start_(lattice_),
        drifted_(lattice_),
        acceleration_(lattice_) {
    house(setup.particles.points, setup.particles.count);
  }

  void house(const PointState* points, std::size_t count) override {
    setup_.points = points;
    setup_.count = count;
    cells_.emplace(setup_, lattice_.stride());
  }
  void gather(PointState* points) const override { cells_->gather(points); }
  [[nodiscard]] int stride() const override { return lattice_.stride(); }
  double* prescribed(int component) override {
    return solve_.prescribed(static_cast<std::size_t>(component));
  }

  Balance project() override {
    sum_momentum_and_mass();
    for (double* field : {mass_[0], right_side_[0], right_side_[1]}) lattice_.join_images(field);
    solve_.matrix().complete();
    solve_.fix_nodes();
    if (!has_projected_) begin_with_quotient(velocity_);
    has_projected_ = true;
    each_value([&](std::size_t c, int i) {  // it drifts by as much as in the step before
      const Lanes drifted = load(velocity_[c] + i) + load(drifted_[c] + i);
      store(drifted_[c] + i, load(velocity_[c] + i));
      store(velocity_[c] + i, drifted);
    });
    const Balance balance = solve_(mass_[0], right_side_, velocity_);
    each_value([&](std::size_t c, int i) {
      store(drifted_[c] + i, load(velocity_[c] + i) - load(drifted_[c] + i));
    });
    start_ = velocity_;
    return balance;
  }

  Balance accelerate(const double b[2]) override {
    sum_forces();
    for (std::size_t c : {0, 1}) {
      double* const f = right_side_[c];
      lattice_.join_images(f);
      lattice_.each_vector([&](int i) { store(f + i, load(f + i) + b[c] * load(mass_[0] + i)); });
    }
    if (!has_accelerated_) begin_with_quotient(acceleration_);
    has_accelerated_ = true;
    return solve_(mass_[0], right_side_, acceleration_);
  }

  void advance_from_start(double dt) override {
    for (std::size_t c : {0, 1}) {
      lattice_.each_vector(
          [&](int i) { store(velocity_[c] + i, load(start_[c] + i) + dt * load(acceleration_[c] + i)); });
      lattice_.fill_margin(velocity_[c]);
    }
  }

  void take() override {
    each_block([&](const Block& block) {
      const Components<CellField<Basis>> v(basis_, block, velocity());
      const Components<CellGradient<Basis>> grad_v(basis_, block, velocity());
      each_slot(block, [&](int k, Slot& p, const Weights& n_p) {
        for (int c : {0, 1}) p.v[c] = v[c].at(n_p);
        if (!setup_.has_pressure) return;
        Affine& l = cells_->affines(block)[static_cast<std::size_t>(k)];
        for (int c : {0, 1}) {
          const auto [d_0, d_1] = grad_v[c].at(n_p);
          l.c[c][0] = d_0 * cell_size(0);
          l.c[c][1] = d_1 * cell_size(1);
        }
      });
    });
  }

  Motion drift(double dt) override {
    const double cells_a_step[2] = {dt * basis_.inverse_h[0], dt * basis_.inverse_h[1]};
    Motion motion;
    Lanes energy = 0, least_volume = 0;
    each_block([&](const Block& block) {
      Lanes lowest = 0, highest = 0;
      for (int k = 0; Slot & p : cells_->slots(block)) {
        if (setup_.has_pressure) {
          strain_straight(cells_->affines(block)[static_cast<std::size_t>(k++)], p, cells_a_step);
          least_volume = least(least_volume, p.volume);
        }
        for (int c : {0, 1}) {
          p.s[c] = select(p.mass > 0, p.s[c] + cells_a_step[c] * p.v[c], p.s[c]);
          lowest = least(lowest, p.s[c]);
          highest = largest(highest, p.s[c]);
          energy += p.v[c] * p.v[c];
        }
      }
      if (((lowest < 0) | (highest >= 1)).any()) cells_->list_movers(block, movers_);
    });
    motion.energy = sum(energy);
    motion.dense = !(least_volume < 0).any();
    motion.inside = cells_->rehouse(movers_);
    movers_.clear();
    return motion;
  }

  [[nodiscard]] double largest_strain_rate() override {
    Lanes most = 0;
    each_block([&](const Block& block) {
      const Components<CellGradient<Basis>> grad_v(basis_, block, velocity());
      each_slot(block, [&](int, const Slot& p, const Weights& n_p) {
        const auto [d_00, d_01] = grad_v[0].at(n_p);
        const auto [d_10, d_11] = grad_v[1].at(n_p);
        const Lanes shear = d_01 + d_10;
        const Lanes squared = 2 * (d_00 * d_00 + d_11 * d_11) + shear * shear;
        most = largest(most, select(p.mass > 0, squared, 0));
      });
    });
    double rate = 0;
    for (int lane = 0; lane < width; ++lane) rate = std::max(rate, most[lane]);
    return std::sqrt(rate);
  }

 private:
  using Basis = PlaneBasis<degree>;
  using Weights = TensorWeights<Basis>;

  void sum_momentum_and_mass() {
    mass_.clear();
    right_side_.clear();
    solve_.matrix().clear();
    NodeSums<Basis, MomentumSums<Basis, true>> node_sums(basis_, {mass_[0], right_side_[0], right_side_[1]});
    each_block([&](const Block& block) {
      MomentumSums<Basis, true> sums;
      CellMass<degree> mass;
      each_slot(block, [&](int, const Slot& p, const Weights& n_p) {
        sums.add(n_p, p.mass, p.v);
        mass.add(p.mass, n_p);
      });
      node_sums.add(block.first_node, sums);
      if (block.size > 0) solve_.matrix().add(block.first_node, mass);
    });
    node_sums.finish();
  }

  /// -sum_p V_p sigma_p grad N_ip, stress and all as in LaneKernel.
  void sum_forces() {
    right_side_.clear();
    with_fluid([&]<class Law, class Pressure>(const Law& law, const Pressure& pressure) {
      NodeSums<Basis, DivergenceSums<Basis>> node_sums(basis_, {right_side_[0], right_side_[1]});
      each_block([&](const Block& block) {
        const Components<CellGradient<Basis>> grad_v(basis_, block, velocity());
        DivergenceSums<Basis> sums;
        each_slot(block, [&](int k, const Slot& p, const Weights& n_p) {
          const auto [d_00, d_01] = grad_v[0].at(n_p);
          const auto [d_10, d_11] = grad_v[1].at(n_p);
          const Lanes density = Pressure::varies ? p.mass / select(p.mass > 0, p.volume, 1) : 0;
          const Stress stress = stress_of(Strained{d_00, d_11, d_01 + d_10, density}, law, pressure, 1);
          cells_->stresses(block)[static_cast<std::size_t>(k)] = stress;
          sums.add(n_p, (0 - p.volume) * stress);
        });
        node_sums.add(block.first_node, sums);
      });
      node_sums.finish();
    });
  }

  /// L turns into L (I + dt L)^-1, the volume grows by det(I + dt L).
  void strain_straight(Affine& gradient, Slot& p, const double cells_a_step[2]) const {
    auto& l = gradient.c;  // times the size of a cell
    const Lanes s_00 = 1 + cells_a_step[0] * l[0][0], s_01 = cells_a_step[1] * l[0][1],
                s_10 = cells_a_step[0] * l[1][0], s_11 = 1 + cells_a_step[1] * l[1][1];
    const Lanes ratio = s_00 * s_11 - s_01 * s_10, determinant = l[0][0] * l[1][1] - l[0][1] * l[1][0];
    const Lanes inverse = 1 / ratio;
    l[0][0] = (l[0][0] + cells_a_step[1] * determinant) * inverse;
    l[1][1] = (l[1][1] + cells_a_step[0] * determinant) * inverse;
    l[0][1] = l[0][1] * inverse;
    l[1][0] = l[1][0] * inverse;
    p.volume = p.volume * ratio;
  }

  /// At the first time a solution is sought from b_i/m_i on, later from what the last ones say.
  void begin_with_quotient(LatticeVector& x) {
    for (std::size_t c : {0, 1})
      lattice_.each_vector([&](int i) {
        const Lanes m = load(mass_[0] + i);
        store(x[c] + i, select(m > 0, load(right_side_[c] + i) / select(m > 0, m, 1), 0));
      });
  }

  /// f(component, i) for the vectors of nodes.
  template <class F>
  void each_value(F&& f) const {
    for (std::size_t c : {0, 1}) lattice_.each_vector([&](int i) { f(c, i); });
  }
  [[nodiscard]] double cell_size(int axis) const { return 1 / basis_.inverse_h[axis]; }
  [[nodiscard]] std::array<double*, 2> velocity() { return {velocity_[0], velocity_[1]}; }

  template <class F>
  [[gnu::flatten]] void each_block(F&& f) {
    for (const Block& block : cells_->blocks({0, setup_.axis[1].cells})) f(block);
  }
  /// f(number, slot, weights)
  template <class F>
  void each_slot(const Block& block, F&& f) {
    for (int k = 0; Slot & p : cells_->slots(block)) f(k++, p, Weights(basis_, block, p.s));
  }
  template <class F>
  void with_fluid(F&& f) const {
    std::visit(
        [&](const auto& law) {
          if (setup_.has_pressure)
            f(law, static_cast<const TaitPressure&>(setup_.pressure));
          else
            f(law, NoPressure{});
        },
        setup_.rheology);
  }

  Lattice lattice_;
  Basis basis_;
  KernelSetup setup_;
  std::optional<Cells> cells_;
  std::vector<Address> movers_;
  MassSolve<degree> solve_;
  LatticeFields<1> mass_;  // sum_p N_ip m_p [kg/m]
  LatticeVector right_side_, velocity_, start_, drifted_, acceleration_;
  bool has_projected_ = false, has_accelerated_ = false;
};

}  // namespace mpm::MPM_ISA
