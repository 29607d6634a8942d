#pragma once

#include <optional>

#include "solver/kernel/full_mass/forecast.hpp"
#include "solver/kernel/full_mass/lattice_reset.hpp"
#include "solver/kernel/full_mass/mass_solve.hpp"
#include "solver/kernel/full_mass/outside_acceleration.hpp"
#include "solver/kernel/full_mass/plane_particles.hpp"

namespace mpm::MPM_ISA {

/// The passes of particles with the consistent mass, in vectors of `width` cells or nodes.
template <int degree>
class LaneFullMass final : public FullMassKernel {
 public:
  explicit LaneFullMass(const FullMassSetup& setup)
      : lattice_(setup.particles.axis, degree),
        bands_(lattice_, setup.particles.axis[1].cells, *setup.team),
        particles_(setup.particles, lattice_, bands_),
        shares_(static_cast<std::size_t>(bands_.count())),
        matrix_(lattice_),
        solve_(lattice_, bands_, matrix_, setup.mass, setup.wall_nodes, setup.negligible_mass),
        mass_(lattice_),
        right_side_(lattice_),
        velocity_(lattice_),
        start_(lattice_),
        middle_acceleration_(lattice_),
        acceleration_(lattice_),
        nothing_(lattice_),
        drifts_(lattice_),
        middle_accelerations_(lattice_),
        changes_(lattice_) {
    if (setup.resets) reset_.emplace(setup, lattice_, bands_, matrix_);
  }

  void gather(PointState* points) const override { particles_.cells().gather(points); }
  [[nodiscard]] KernelTotals totals() override {
    const auto [mass, momentum_0, momentum_1, energy] =
        bands_.sum_of_cells<4>([&](Rows rows, Lanes(&sums)[4]) {
          particles_.each_block(rows, [&](const Block& block) {
            for (const Slot& p : particles_.cells().slots(block)) {
              sums[0] += p.mass;
              for (int c : {0, 1}) sums[1 + c] += p.mass * p.v[c];
              sums[3] += 0.5 * p.mass * (p.v[0] * p.v[0] + p.v[1] * p.v[1]);
            }
          });
        });
    return {mass, {momentum_0, momentum_1}, energy};
  }
  [[nodiscard]] int stride() const override { return lattice_.stride(); }
  double* prescribed(int component) override {
    return solve_.prescribed(static_cast<std::size_t>(component));
  }
  [[nodiscard]] const double* velocity(int component) const override {
    return velocity_[static_cast<std::size_t>(component)];
  }

  Balance project() override {
    sum_momentum_and_mass();
    // The field that the particles took last, and what a drift makes of it.
    const Balance balance = kicked_ ? solve(velocity_, *kicked_, drifts_, {{0, 0}})
                                    : solve_(mass_[0], right_side_, velocity_, {{0, 0}});
    energy_ = bands_.sum([&](int i, Lanes(&sum)[2]) {
      for (std::size_t c : {0, 1}) {
        const Lanes v = load(velocity_[c] + i);
        store(start_[c] + i, v);
        sum[c] += load(mass_[0] + i) * v * v;
      }
    });
    return balance;
  }

  Balance project_aside() override {
    sum_momentum_and_mass();
    if (kicked_) drifts_.read(bands_, time_, *kicked_, velocity_, 0.5);  // half the drift is to come
    return solve_(mass_[0], right_side_, velocity_, {{0, 0}});
  }

  Balance kick(Kick which, const double b[2], double dt) override {
    sum_forces(b);
    // dt a is added to the velocity, which is known to 1e-14 by its own solve. The whole kick differs little
    // from that to the middle, and by nearly as much as in the step before.
    const Both beside{{energy_.of[0] / (dt * dt), energy_.of[1] / (dt * dt)}};
    const bool whole = which == Kick::Whole;
    LatticeVector& a = whole ? acceleration_ : middle_acceleration_;
    const Balance balance = whole ? solve(a, middle_acceleration_, changes_, beside)
                                  : solve(a, nothing_, middle_accelerations_, beside);
    bands_.each_vector_with_margins(velocity_, [&](int i) {
      for (std::size_t c : {0, 1}) store(velocity_[c] + i, load(start_[c] + i) + dt * load(a[c] + i));
    });
    if (whole) kicked_ = velocity_;
    return balance;
  }

  void take() override {
    bands_.each_of_cells([&](int, Rows rows) {
      particles_.each_block(rows, [&](const Block& block) {
        const Components<CellField<Basis>> v(particles_.basis(), block, velocity());
        const Components<CellGradient<Basis>> grad_v(particles_.basis(), block, velocity());
        particles_.each_slot(block, [&](int k, Slot& p, const Weights& n_p) {
          for (int c : {0, 1}) p.v[c] = v[c].at(n_p);
          if (!particles_.has_pressure()) return;
          Affine& l = particles_.affine(block, k);
          for (int c : {0, 1}) {
            const auto [d_0, d_1] = grad_v[c].at(n_p);
            l.c[c][0] = d_0 * particles_.cell_size(0);
            l.c[c][1] = d_1 * particles_.cell_size(1);
          }
        });
      });
    });
  }

  void set_stress() override {
    bands_.each_of_cells(
        [&](int, Rows rows) { particles_.each_block(rows, [&](const Block& block) { set_stress(block); }); });
  }

  Motion drift(double dt) override {
    time_ += dt;
    const double cells_a_step[2] = {dt * particles_.basis().inverse_h[0],
                                    dt * particles_.basis().inverse_h[1]};
    bands_.each_of_cells([&](int band, Rows rows) {
      Share& share = shares_[static_cast<std::size_t>(band)];
      Lanes energy = 0, least_volume = 0;
      particles_.each_block(rows, [&](const Block& block) {
        Lanes lowest = 0, highest = 0;
        for (int k = 0; Slot & p : particles_.cells().slots(block)) {
          if (particles_.has_pressure()) {
            strain_straight(particles_.affine(block, k++), p, cells_a_step);
            least_volume = least(least_volume, p.volume);
          }
          for (int c : {0, 1}) {
            p.s[c] = select(p.mass > 0, p.s[c] + cells_a_step[c] * p.v[c], p.s[c]);
            lowest = least(lowest, p.s[c]);
            highest = largest(highest, p.s[c]);
            energy += p.v[c] * p.v[c];
          }
        }
        if (((lowest < 0) | (highest >= 1)).any()) particles_.cells().take_out_movers(block, share.movers);
      });
      share.energy = sum(energy);
      share.dense = !(least_volume < 0).any();
    });
    Motion motion;
    for (Share& share : shares_) {
      motion.energy += share.energy;
      motion.dense &= share.dense;
      motion.inside &= particles_.cells().rehouse(share.movers);
      share.movers.clear();
    }
    return motion;
  }

  [[nodiscard]] double largest_strain_rate() override {
    bands_.each_of_cells([&](int band, Rows rows) {
      Lanes most = 0;
      particles_.each_block(rows, [&](const Block& block) {
        const Components<CellGradient<Basis>> grad_v(particles_.basis(), block, velocity());
        particles_.each_slot(block, [&](int, const Slot& p, const Weights& n_p) {
          const auto [d_00, d_01] = grad_v[0].at(n_p);
          const auto [d_10, d_11] = grad_v[1].at(n_p);
          const Lanes shear = d_01 + d_10;
          const Lanes squared = 2 * (d_00 * d_00 + d_11 * d_11) + shear * shear;
          most = largest(most, select(p.mass > 0, squared, 0));
        });
      });
      shares_[static_cast<std::size_t>(band)].strain_rate_squared = largest(most);
    });
    double squared = 0;
    for (const Share& share : shares_) squared = std::max(squared, share.strain_rate_squared);
    return std::sqrt(squared);
  }

  void reset() override {
    const Balance momentum = project_aside();
    reset_->project_density(particles_, mass_[0]);
    particles_.put_back();
    take();
    reset_->take_density(particles_, momentum.asked);
    set_stress();
  }

  void positions(double* const x[2]) const override { OutsideAcceleration<degree>::positions(particles_, x); }
  void accelerate_particles(const double* const b[2], double force[2]) override {
    outside_.set(particles_, b, force);
  }

  /// Iterations of all solves so far.
  [[nodiscard]] long iterations() const { return solve_.iterations(); }

 private:
  using Basis = typename PlaneParticles<degree>::Basis;
  using Weights = typename PlaneParticles<degree>::Weights;

  /// What the particles of a band add up to.
  struct alignas(64) Share {
    double energy = 0, strain_rate_squared = 0;
    bool dense = true;
    std::vector<Mover> movers;
  };

  /// Mass, its matrix and momentum of the particles, complete for a solve.
  void sum_momentum_and_mass() {
    bands_.each_of_cells([&](int band, Rows cells) {
      const Rows rows = nodes_of(band, cells);
      mass_.clear(lattice_, rows);
      right_side_.clear(lattice_, rows);
      matrix_.clear(rows);
    });
    particles_.template scatter<MomentumSums<Basis, true>>(
        {mass_[0], right_side_[0], right_side_[1]}, [&](const Block& block, auto& sums) {
          CellMass<degree> mass;
          particles_.each_slot(block, [&](int, const Slot& p, const Weights& n_p) {
            sums.add(n_p, p.mass, p.v);
            mass.add(p.mass, n_p);
          });
          if (block.size > 0) matrix_.add(block.first_node, mass);
        });
    bands_.each(3, [&](int field) {
      lattice_.join_images(field == 0 ? mass_[0] : right_side_[static_cast<std::size_t>(field) - 1]);
    });
    matrix_.complete(bands_);
    solve_.fix_nodes(mass_[0]);
  }

  /// m_i b + sum_p N_ip m_p b_p - sum_p V_p sigma_p grad N_ip, stress and all as in LaneKernel.
  void sum_forces(const double b[2]) {
    bands_.each_of_cells([&](int band, Rows cells) { right_side_.clear(lattice_, nodes_of(band, cells)); });
    // A Newtonian stress is a few products: written out, it saves a second loop over the slots.
    const bool is_summed = particles_.with_newtonian([&](const auto& law, const auto& pressure) {
      scatter_forces([&](const Block& block, auto& sums) {
        const Components<CellGradient<Basis>> grad_v(particles_.basis(), block, velocity());
        particles_.each_slot(block, [&](int k, const Slot& p, const Weights& n_p) {
          Strained strained = strained_at(n_p, grad_v);
          if (pressure.varies) strained.density = density_of(p);
          const Stress stress = stress_of(strained, law, pressure, 1);
          particles_.cells().stresses(block)[static_cast<std::size_t>(k)] = stress;
          sums.add(n_p, (0 - p.volume) * stress);
        });
      });
    });
    if (!is_summed)
      scatter_forces([&](const Block& block, auto& sums) {
        set_stress(block);
        const Stress* const stress = particles_.cells().stresses(block).data();
        particles_.each_slot(block, [&](int k, const Slot& p, const Weights& n_p) {
          sums.add(n_p, (0 - p.volume) * stress[k]);
        });
      });
    outside_.add_forces(particles_, {right_side_[0], right_side_[1]});
    bands_.each(2, [&](int c) { lattice_.join_images(right_side_[static_cast<std::size_t>(c)]); });
    bands_.each_vector([&](int i) {
      for (std::size_t c : {0, 1}) {
        double* const f = right_side_[c] + i;
        store(f, load(f) + b[c] * load(mass_[0] + i));
      }
    });
  }

  template <class Give>
  void scatter_forces(const Give& give) {
    particles_.template scatter<DivergenceSums<Basis>>({right_side_[0], right_side_[1]}, give);
  }

  /// Stress of a block's particles from the nodal velocity. The fluid is asked about some of them at a time:
  /// compiled for every one, the passes would be most of what a build waits for.
  void set_stress(const Block& block) {
    constexpr std::size_t some = 32;
    Strained strained[some];
    const Components<CellGradient<Basis>> grad_v(particles_.basis(), block, velocity());
    const std::span<const Slot> slots = particles_.cells().slots(block);
    Stress* stress = particles_.cells().stresses(block).data();
    for (std::size_t first = 0; first < slots.size(); first += some) {
      const std::span<const Slot> these = slots.subspan(first, std::min(some, slots.size() - first));
      for (std::size_t k = 0; k < these.size(); ++k)
        strained[k] = strained_at(Weights(particles_.basis(), block, these[k].s), grad_v);
      if (particles_.has_pressure())
        for (std::size_t k = 0; k < these.size(); ++k) strained[k].density = density_of(these[k]);
      particles_.set_stress({strained, these.size()}, stress);
      stress += these.size();
    }
  }
  static Strained strained_at(const Weights& n_p, const Components<CellGradient<Basis>>& grad_v) {
    const auto [d_00, d_01] = grad_v[0].at(n_p);
    const auto [d_10, d_11] = grad_v[1].at(n_p);
    return {d_00, d_11, d_01 + d_10, 0};
  }
  static Lanes density_of(const Slot& p) { return p.mass / select(p.mass > 0, p.volume, 1); }

  /// The rows of nodes that begin with a band's cells: with the last ones up to the end of the margin.
  [[nodiscard]] Rows nodes_of(int band, Rows cells) const {
    return {cells.begin, band + 1 < bands_.count() ? cells.end : lattice_.rows()};
  }

  /// L turns into L (I + dt L)^-1, the volume grows by det(I + dt L).
  static void strain_straight(Affine& gradient, Slot& p, const double cells_a_step[2]) {
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

  /// Solves for x, from where a forecast of its difference to `base` says that it is.
  Balance solve(LatticeVector& x, const LatticeVector& base, Forecast& forecast, const Both& beside) {
    forecast.read(bands_, time_, base, x, 1);
    const Balance balance = solve_(mass_[0], right_side_, x, beside);
    forecast.keep(bands_, time_, base, x);
    return balance;
  }

  [[nodiscard]] std::array<double*, 2> velocity() { return {velocity_[0], velocity_[1]}; }

  Lattice lattice_;
  Bands bands_;
  PlaneParticles<degree> particles_;
  std::vector<Share> shares_;  // one a band
  OutsideAcceleration<degree> outside_;
  MassMatrix<degree> matrix_;
  MassSolve<degree> solve_;
  std::optional<LatticeReset<degree>> reset_;
  LatticeFields<1> mass_;  // sum_p N_ip m_p [kg/m]
  LatticeVector right_side_, velocity_, start_, middle_acceleration_, acceleration_, nothing_;
  std::optional<LatticeVector> kicked_;  // the velocity that the last step ended with
  // What drifts add to it; accelerations, and their changes from the middle of a step to the whole.
  Forecast drifts_, middle_accelerations_, changes_;
  Both energy_{{0, 0}};  // sum_i m_i v_i^2 at the start [kg m/s2]
  double time_ = 0;      // of particles, since the first drift [s]
};

}  // namespace mpm::MPM_ISA
