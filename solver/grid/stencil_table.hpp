#pragma once

#include "solver/grid/stencil.hpp"
#include "solver/particles.hpp"

namespace mpm {

/// The stencils of all particles written out, for work on matrices: code that reads it is compiled once for
/// every basis. Entry p * width + k is the k-th node of particle p,
/// x running first.
struct StencilTable {
  int width = 0, support_x = 0;
  std::vector<int> node;
  ScalarField value;     ///< N_ip [-]
  VectorField gradient;  ///< grad N_ip [1/m]

  template <class Basis>
  void assign(const Grid& grid, const Particles& particles) {
    support_x = Stencil<Basis>::support_x;
    width = support_x * Stencil<Basis>::support_y;
    const std::size_t entries = particles.size() * static_cast<std::size_t>(width);
    node.resize(entries);
    value.resize(entries);
    gradient.resize(entries);
    std::size_t e = 0;
    for (const Vec2& x_p : particles.position)
      Stencil<Basis>(grid, x_p).all([&](std::size_t i, double n, const Vec2& dn) {
        node[e] = static_cast<int>(i);
        value[e] = n;
        gradient[e] = dn;
        ++e;
      });
  }
};

}  // namespace mpm
