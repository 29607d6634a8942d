#pragma once

#include <array>
#include <vector>

#include "solver/kernel/full_mass/plane_particles.hpp"

namespace mpm::MPM_ISA {

/// Accelerations that particles get from outside, each its own, told by somebody who asks where they are: one
/// after another, in the order of blocks, lanes and slots, which stands until they move.
template <int degree>
class OutsideAcceleration {
 public:
  /// Where the particles are [m].
  static void positions(const PlaneParticles<degree>& particles, double* const x[2]) {
    const Cells& cells = particles.cells();
    each_particle(particles, [&](std::size_t n, const Block& block, std::size_t slot, int lane) {
      const int number = block.first_node + lane;
      const int cell[2] = {number % cells.stride(), number / cells.stride()};
      for (int a : {0, 1}) x[a][n] = (cell[a] + cells.slots(block)[slot].s[a][lane]) * particles.cell_size(a);
    });
  }

  /// What they are accelerated by [m/s2]; sum_p m_p b_p through `force` [N/m].
  void set(const PlaneParticles<degree>& particles, const double* const b[2], double force[2]) {
    force[0] = force[1] = 0;
    each_particle(particles, [&](std::size_t n, const Block& block, std::size_t slot, int lane) {
      const std::size_t at = block.first_slot + slot;
      if (at >= of_.size()) of_.resize(at + 1, {{0, 0}});
      for (int c : {0, 1}) {
        of_[at].of[c][lane] = b[c][n];
        force[c] += particles.cells().slots(block)[slot].mass[lane] * b[c][n];
      }
    });
  }

  /// f_i += sum_p N_ip m_p b_p
  void add_forces(PlaneParticles<degree>& particles, const std::array<double*, 2>& f) const {
    if (of_.empty()) return;
    particles.template scatter<MomentumSums<Basis, false>>(f, [&](const Block& block, auto& sums) {
      particles.each_slot(block, [&](int k, const Slot& p, const auto& n_p) {
        sums.add(n_p, p.mass, of_[block.first_slot + static_cast<std::size_t>(k)].of);
      });
    });
  }

 private:
  using Basis = typename PlaneParticles<degree>::Basis;

  /// f(number, block, slot, lane)
  template <class F>
  static void each_particle(const PlaneParticles<degree>& particles, F&& f) {
    std::size_t n = 0;
    for (const Block& block : particles.cells().blocks(particles.rows()))
      for (int lane = 0; lane < width; ++lane)
        for (int k = 0; k < block.count[lane]; ++k) f(n++, block, static_cast<std::size_t>(k), lane);
  }

  struct Pair {
    Lanes of[2];
  };
  std::vector<Pair> of_;  // of the particles of a slot, as they lie in the store
};

}  // namespace mpm::MPM_ISA
