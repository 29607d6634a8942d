#pragma once

#include <optional>

#include "solver/kernel/full_mass/forecast.hpp"
#include "solver/kernel/full_mass/mass_solve.hpp"

namespace mpm::MPM_ISA {

/// What nodes have in the passes with the consistent mass, and what of a step is theirs alone: nothing of it
/// depends on the basis.
class FullMassNodes {
 public:
  FullMassNodes(const FullMassSetup& setup, const Lattice& lattice, const Bands& bands,
                const LatticeMatrix& matrix)
      : lattice_(lattice),
        bands_(bands),
        solve_(lattice, bands, matrix, setup.mass, setup.wall_nodes, setup.negligible_mass),
        mass_(lattice),
        right_side_(lattice),
        velocity_(lattice),
        start_(lattice),
        middle_acceleration_(lattice),
        acceleration_(lattice),
        nothing_(lattice),
        drifts_(lattice),
        middle_accelerations_(lattice),
        changes_(lattice) {}

  double* prescribed(int component) { return solve_.prescribed(static_cast<std::size_t>(component)); }
  [[nodiscard]] std::array<double*, 2> velocity() { return {velocity_[0], velocity_[1]}; }
  [[nodiscard]] const double* velocity(int component) const {
    return velocity_[static_cast<std::size_t>(component)];
  }
  /// sum_p N_ip m_p [kg/m].
  [[nodiscard]] double* mass() { return mass_[0]; }
  /// Of the next solve: what particles add up, momentum [kg/s] or force [N/m].
  [[nodiscard]] std::array<double*, 2> right_side() { return {right_side_[0], right_side_[1]}; }
  /// Iterations of all solves so far.
  [[nodiscard]] long iterations() const { return solve_.iterations(); }

  /// Before particles are summed: rows of nodes become zero.
  void clear_mass(Rows rows) { mass_.clear(lattice_, rows); }
  void clear_right_side(Rows rows) { right_side_.clear(lattice_, rows); }

  /// When mass and momentum of the particles have been summed, and the matrix is complete.
  void complete_mass() {
    bands_.each(3, [&](int field) {
      lattice_.join_images(field == 0 ? mass_[0] : right_side_[static_cast<std::size_t>(field) - 1]);
    });
    solve_.fix_nodes(mass_[0]);
  }
  /// When forces have been summed: m_i b is added.
  void complete_forces(const double b[2]) {
    bands_.each(2, [&](int c) { lattice_.join_images(right_side_[static_cast<std::size_t>(c)]); });
    bands_.each_vector([&](int i) {
      for (std::size_t c : {0, 1}) {
        double* const f = right_side_[c] + i;
        store(f, load(f) + b[c] * load(mass_[0] + i));
      }
    });
  }

  /// As FullMassKernel.
  Balance project() {
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

  /// As FullMassKernel.
  Balance project_aside() {
    if (kicked_) drifts_.read(bands_, time_, *kicked_, velocity_, 0.5);  // half the drift is to come
    return solve_(mass_[0], right_side_, velocity_, {{0, 0}});
  }

  /// As FullMassKernel.
  Balance kick(Kick which, double dt) {
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

  /// When the particles have moved for dt [s].
  void pass(double dt) { time_ += dt; }

 private:
  /// Solves for x, from where a forecast of its difference to `base` says that it is.
  Balance solve(LatticeVector& x, const LatticeVector& base, Forecast& forecast, const Both& beside) {
    forecast.read(bands_, time_, base, x, 1);
    const Balance balance = solve_(mass_[0], right_side_, x, beside);
    forecast.keep(bands_, time_, base, x);
    return balance;
  }

  const Lattice& lattice_;
  const Bands& bands_;
  MassSolve solve_;
  LatticeFields<1> mass_;
  LatticeVector right_side_, velocity_, start_, middle_acceleration_, acceleration_, nothing_;
  std::optional<LatticeVector> kicked_;  // the velocity that the last step ended with
  // What drifts add to it; accelerations, and their changes from the middle of a step to the whole.
  Forecast drifts_, middle_accelerations_, changes_;
  Both energy_{{0, 0}};  // sum_i m_i v_i^2 at the start [kg m/s2]
  double time_ = 0;      // of particles, since the first drift [s]
};

}  // namespace mpm::MPM_ISA
