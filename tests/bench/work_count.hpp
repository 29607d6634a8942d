#pragma once

#include "tests/bench/counted.hpp"
#include "tests/bench/plain_loop.hpp"

namespace bench {

/// Floating-point operations a particle and step of the paper's scheme and scene (linear basis, FLIP, update
/// stress first, Newtonian, 2 x 2 particles a cell; the nodes' share included): counted, by the plain loop
/// with a number that counts.
inline double operations_per_particle_step() {
  plain::Loop<plain::Newtonian, plain::Counted> loop({0.5e-3, 1e-3, 10, 20, 2, 1000, 143, 8e-3, true},
                                                     {1e-3});
  plain::Counted::operations = 0;
  loop.step(5e-6);
  return static_cast<double>(plain::Counted::operations) / static_cast<double>(loop.particles().size());
}

/// Bytes a particle and step that the kernel's three passes must move when no cache holds the particles:
/// nine numbers (x, v, m, V, sigma), of which
///   P2G reads x, v, m                                            5
///   stress and forces read x, m, V and write V, sigma            4 + 4
///   G2P and move read x, v, m, V and write x, v                  6 + 4
/// Nodes are few beside them and stay in the cache.
constexpr double bytes_per_particle_step = 8 * (5 + 4 + 4 + 6 + 4);

}  // namespace bench
