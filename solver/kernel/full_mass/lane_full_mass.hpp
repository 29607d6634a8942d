#pragma once

#include <optional>

#include "solver/kernel/full_mass/full_mass_nodes.hpp"
#include "solver/kernel/full_mass/lattice_reset.hpp"
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
        nodes_(setup, lattice_, bands_, matrix_) {
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
  double* prescribed(int component) override { return nodes_.prescribed(component); }
  [[nodiscard]] const double* velocity(int component) const override { return nodes_.velocity(component); }

  Balance project() override {
    sum_momentum_and_mass();
    return nodes_.project();
  }

  Balance project_aside() override {
    sum_momentum_and_mass();
    return nodes_.project_aside();
  }

  Balance kick(Kick which, const double b[2], double dt) override {
    sum_forces(b);
    return nodes_.kick(which, dt);
  }

  void take() override {
    bands_.each_of_cells([&](int, Rows rows) {
      particles_.each_block(rows, [&](const Block& block) {
        const Components<CellField<Basis>> v(particles_.basis(), block, nodes_.velocity());
        const Components<CellGradient<Basis>> grad_v(particles_.basis(), block, nodes_.velocity());
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
    nodes_.pass(dt);
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
        const Components<CellGradient<Basis>> grad_v(particles_.basis(), block, nodes_.velocity());
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
    reset_->project_density(particles_, nodes_.mass());
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
  [[nodiscard]] long iterations() const { return nodes_.iterations(); }

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
  [[gnu::noinline]] void sum_momentum_and_mass() {
    bands_.each_of_cells([&](int band, Rows cells) {
      const Rows rows = nodes_of(band, cells);
      nodes_.clear_mass(rows);
      nodes_.clear_right_side(rows);
      matrix_.clear(rows);
    });
    const auto [momentum_0, momentum_1] = nodes_.right_side();
    particles_.template scatter<MomentumSums<Basis, true>>(
        {nodes_.mass(), momentum_0, momentum_1}, [&](const Block& block, auto& sums) {
          CellMass<degree> mass;
          particles_.each_slot(block, [&](int, const Slot& p, const Weights& n_p) {
            sums.add(n_p, p.mass, p.v);
            mass.add(p.mass, n_p);
          });
          if (block.size > 0) matrix_.add(block.first_node, mass);
        });
    matrix_.complete(bands_);
    nodes_.complete_mass();
  }

  /// m_i b + sum_p N_ip m_p b_p - sum_p V_p sigma_p grad N_ip, stress and all as in LaneKernel.
  void sum_forces(const double b[2]) {
    bands_.each_of_cells([&](int band, Rows cells) { nodes_.clear_right_side(nodes_of(band, cells)); });
    // A Newtonian stress is a few products: written out, it saves a second loop over the slots.
    const bool is_summed = particles_.with_newtonian([&](const auto& law, const auto& pressure) {
      scatter_forces([&](const Block& block, auto& sums) {
        const Components<CellGradient<Basis>> grad_v(particles_.basis(), block, nodes_.velocity());
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
    outside_.add_forces(particles_, nodes_.right_side());
    nodes_.complete_forces(b);
  }

  template <class Give>
  void scatter_forces(const Give& give) {
    particles_.template scatter<DivergenceSums<Basis>>(nodes_.right_side(), give);
  }

  /// Stress of a block's particles from the nodal velocity. The fluid is asked about some of them at a time:
  /// compiled for every one, the passes would be most of what a build waits for.
  void set_stress(const Block& block) {
    constexpr std::size_t some = 32;
    Strained strained[some];
    const Components<CellGradient<Basis>> grad_v(particles_.basis(), block, nodes_.velocity());
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

  Lattice lattice_;
  Bands bands_;
  PlaneParticles<degree> particles_;
  std::vector<Share> shares_;  // one a band
  OutsideAcceleration<degree> outside_;
  MassMatrix<degree> matrix_;
  FullMassNodes nodes_;
  std::optional<LatticeReset<degree>> reset_;
};

}  // namespace mpm::MPM_ISA
