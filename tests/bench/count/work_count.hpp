#pragma once

#include "tests/bench/count/counted.hpp"
#include "tests/bench/plain/plain_loop.hpp"

namespace bench {

/// Floating-point operations a particle and step of the vector kernel in the paper's scheme and scene (linear
/// basis, FLIP, update stress first, Newtonian, 2 x 2 particles a cell; the nodes' share included), as its
/// source has them: sums, products and quotients one each, comparisons none.
double kernel_operations_per_particle_step();

/// The same of quadratic APIC in vortices.
double apic_operations_per_particle_step();

/// The same of cubic full mass in leapfrog steps, its solves included, and what these take.
struct FullMassCount {
  double operations, iterations_a_solve;
};
FullMassCount full_mass_count();

/// The same of the plain loop, counted by the loop with a number that counts.
inline double plain_operations_per_particle_step() {
  plain::Loop<plain::Newtonian, plain::Counted> loop({0.5e-3, 1e-3, 10, 20, 2, 1000, 143, 8e-3, true},
                                                     {1e-3});
  plain::Counted::operations = 0;
  loop.step(5e-6);
  return static_cast<double>(plain::Counted::operations) / static_cast<double>(loop.particles().size());
}

/// Bytes a particle and step that a sweep of the kernel must move when no cache holds particles and nodes
/// from one step to the next, four particles a node:
///   a particle's place, v, m, V are read and, as whole cache lines, written   6 + 6
///   a node's 1/m, v, a are fetched and written, a quarter of                  5 + 5
constexpr double bytes_per_particle_step = 8 * (6 + 6 + (5 + 5) / 4.0);
/// The same with an affine field of four numbers a particle (APIC).
constexpr double bytes_per_affine_particle_step = bytes_per_particle_step + 8 * (4 + 4);
/// Of full mass in leapfrog steps, cubic, four particles a node, when the caches hold nothing from one pass
/// to the next:
///   a particle's place, v, m, V are read by six passes (two drifts, projection, two kicks, G2P), its affine
///   field by the drifts; drifts and G2P write both, kicks its stress        6 * 6 + 2 * 4 + 3 * 10 + 2 * 3
///   the 25 entries of a node are cleared, added to and completed, and read once a product, and so are eight
///   vectors of the iteration with two components each, a quarter of
///                                              25 * 5 + 3 * (iterations a solve + 1) * (25 + 8 * 2)
inline double bytes_per_full_mass_particle_step(double iterations_a_solve) {
  return 8 * (6 * 6 + 2 * 4 + 3 * 10 + 2 * 3 + (25 * 5 + 3 * (iterations_a_solve + 1) * (25 + 8 * 2)) / 4);
}

}  // namespace bench
