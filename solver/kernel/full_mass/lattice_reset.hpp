#pragma once

#include "solver/kernel/full_mass/mass_solve.hpp"
#include "solver/kernel/full_mass/plane_particles.hpp"

namespace mpm::MPM_ISA {

/// Puts the particles back on the lattice that they were seeded on, with what the grid knows of the fluid
/// (ParticleReset, solver/transfer, whose notes hold here).
template <int degree>
class LatticeReset {
 public:
  LatticeReset(const FullMassSetup& setup, const Lattice& lattice, const Bands& bands,
               const LatticeMatrix& matrix)
      : lattice_(lattice),
        bands_(bands),
        density_solve_(lattice, bands, matrix, setup.whole_mass, {}, setup.negligible_mass),
        right_side_(lattice),
        density_(lattice),
        weight_(lattice) {
    for (std::size_t p = 0; p < setup.particles.count; ++p) mass_ += setup.particles.points[p].mass;
    for (int row = 0; row < lattice.count(1); ++row)
      std::fill_n(weight_[0] + row * lattice.stride(), lattice.count(0), 1.0);
    for (const int wall : setup.wall_nodes) weight_[0][lattice.place_of(wall)] = 0;
    lattice.fill_margins(weight_[0], {0, lattice.count(1)});
  }

  /// Density on the nodes, M^-1 sum_p N_ip m_p rho_p, of particles that the matrix and `mass`, sum_p N_ip
  /// m_p, belong to.
  void project_density(PlaneParticles<degree>& particles, const double* mass) {
    right_side_.clear(lattice_, {0, lattice_.rows()});
    particles.template scatter<MomentumSums<Basis, false>>(
        {right_side_[0], right_side_[1]}, [&](const Block& block, auto& sums) {
          particles.each_slot(block, [&](int, const Slot& p, const Weights& n_p) {
            const Lanes density[2] = {p.mass / select(p.mass > 0, p.volume, 1), 0};
            sums.add(n_p, p.mass, density);
          });
        });
    bands_.each(2, [&](int c) { lattice_.join_images(right_side_[static_cast<std::size_t>(c)]); });
    density_solve_.fix_nodes(mass);
    bands_.each_vector([&](int i) {
      const Lanes m = load(mass + i);
      store(density_[0] + i, load(right_side_[0] + i) / select(m > 0, m, 1));
    });
    density_solve_(mass, right_side_, density_, {{0, 0}});
  }

  /// Gives particles that are on the lattice, with the velocity of the nodes, the density that has been
  /// projected. Mends both so that mass is that of the start and momentum as given [kg/s].
  void take_density(PlaneParticles<degree>& particles, const double momentum[2]) {
    const auto [mass, momentum_0, momentum_1, movable] = sample_density(particles);
    const double factor = mass_ / mass;
    // None when every function belongs to a wall.
    const double per_mass = movable > 0 ? 1 / (factor * movable) : 0;
    const double missing[2] = {per_mass * (momentum[0] - factor * momentum_0),
                               per_mass * (momentum[1] - factor * momentum_1)};
    bands_.each_of_cells([&](int, Rows rows) {
      particles.each_block(rows, [&](const Block& block) {
        const CellField<Basis> weight(particles.basis(), block, weight_[0]);
        particles.each_slot(block, [&](int, Slot& p, const Weights& n_p) {
          p.mass = factor * p.mass;
          const Lanes w = weight.at(n_p);
          for (int c : {0, 1}) p.v[c] += missing[c] * w;
        });
      });
    });
  }

 private:
  using Basis = typename PlaneParticles<degree>::Basis;
  using Weights = typename PlaneParticles<degree>::Weights;

  /// A particle's mass becomes its density times its share of the domain. Returns sums of m_p, of both
  /// components of m_p v_p, and of m_p w_p, w the weight.
  std::array<double, 4> sample_density(PlaneParticles<degree>& particles) {
    return bands_.sum_of_cells<4>([&](Rows rows, Lanes(&sums)[4]) {
      particles.each_block(rows, [&](const Block& block) {
        const CellField<Basis> density(particles.basis(), block, density_[0]);
        const CellField<Basis> weight(particles.basis(), block, weight_[0]);
        particles.each_slot(block, [&](int, Slot& p, const Weights& n_p) {
          p.mass = density.at(n_p) * p.volume;
          sums[0] += p.mass;
          for (int c : {0, 1}) sums[1 + c] += p.mass * p.v[c];
          sums[3] += p.mass * weight.at(n_p);
        });
      });
    });
  }

  const Lattice& lattice_;
  const Bands& bands_;
  MassSolve density_solve_;
  LatticeVector right_side_, density_;  // their second components are nothing
  // One away from walls, falling to zero on them: what may be added to a velocity without moving a wall.
  LatticeFields<1> weight_;
  double mass_ = 0;  // of all particles [kg/m]
};

}  // namespace mpm::MPM_ISA
