#pragma once

#include "solver/grid/remembered.hpp"
#include "solver/grid/stencil.hpp"
#include "solver/particles.hpp"

namespace mpm {

/// The stencils of all particles written out, for work on matrices: code that reads it is compiled once for
/// every basis. Entry p * width + k is the k-th node of particle p, x running first.
struct StencilTable {
  int width = 0, support_x = 0;
  std::vector<int> node;
  ScalarField value;     ///< N_ip [-]
  VectorField gradient;  ///< grad N_ip [1/m]

  template <class Basis>
  void assign(const Grid& grid, const Particles& particles) {
    // Rows that slide along a strip keep their stencils.
    if constexpr (Basis::X::support == 1)
      if (across_.same(particles.size(), [&](std::size_t p) { return particles.position[p].y(); })) return;
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

  /// A particle's, as Stencil.
  struct Row {
    const int* node;
    const double* value;
    const Vec2* gradient;
    int width;
    /// visit(node i, N_ip)
    template <class Visit>
    void values(Visit&& visit) const {
      for (int k = 0; k < width; ++k) visit(static_cast<std::size_t>(node[k]), value[k]);
    }
    /// visit(node i, grad N_ip)
    template <class Visit>
    void gradients(Visit&& visit) const {
      for (int k = 0; k < width; ++k) visit(static_cast<std::size_t>(node[k]), gradient[k]);
    }
  };
  [[nodiscard]] Row stencil(std::size_t p) const {
    const std::size_t first = p * static_cast<std::size_t>(width);
    return {node.data() + first, value.data() + first, gradient.data() + first, width};
  }

 private:
  Remembered across_;  // coordinates [m]
};

}  // namespace mpm
