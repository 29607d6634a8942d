#pragma once

#include "solver/kernel/cells.hpp"

namespace mpm::MPM_ISA {

/// The basis on the grid that a kernel works on, across the lanes of a vector.
template <int polynomial_degree, bool is_strip>
struct LaneBasis {
  static constexpr int degree = polynomial_degree;
  static constexpr int support[2] = {degree + 1, is_strip ? 1 : degree + 1};
  static constexpr int nodes = support[0] * support[1];  ///< that a cell touches: k along, l across the lanes
  double inverse_h[2];                                   ///< [1/m]
  int stride;                                            ///< from a node to the next across the lanes

  /// Distance of a cell's i-th node from its first, in the numbering of nodes.
  [[nodiscard]] int offset(int i) const { return i / support[0] * stride + i % support[0]; }
};

/// N and dN/dx of one axis, in the cells of a block: values [-] and slopes [1/m].
template <int degree, int support>
struct LineWeights {
  Lanes value[support], slope[support];

  LineWeights(Lanes s, double inverse_h, const Lanes* polynomials) {
    if constexpr (support == 1) {  // nothing varies along this axis
      value[0] = 1;
      slope[0] = 0;
    } else if constexpr (degree == 1) {
      value[0] = 1 - s;
      value[1] = s;
      slope[0] = -inverse_h;
      slope[1] = inverse_h;
    } else {
      unroll<support>([&](int k) {
        Lanes n = polynomials[degree * support + k], dn = 0;
        unroll<degree>([&](int step) {
          dn = dn * s + n;
          n = n * s + polynomials[(degree - 1 - step) * support + k];
        });
        value[k] = n;
        slope[k] = dn * inverse_h;
      });
    }
  }
};

/// N_ip and grad N_ip of the particles of a slot at the nodes i of their cells.
template <class Basis>
class CellWeights {
 public:
  CellWeights(const Basis& basis, const Block& block, const Lanes x[2])
      : along_(x[0] * basis.inverse_h[0] - block.cell[0], basis.inverse_h[0], block.polynomials[0]),
        across_(x[1] * basis.inverse_h[1] - block.cell[1], basis.inverse_h[1], block.polynomials[1]) {}

  /// visit(i, N_i)
  template <class Visit>
  void values(Visit&& visit) const {
    unroll<Basis::nodes>([&](int i) { visit(i, along_.value[k(i)] * across_.value[l(i)]); });
  }

  /// visit(i, dN_i/dx_0, dN_i/dx_1)
  template <class Visit>
  void gradients(Visit&& visit) const {
    unroll<Basis::nodes>([&](int i) {
      visit(i, along_.slope[k(i)] * across_.value[l(i)], along_.value[k(i)] * across_.slope[l(i)]);
    });
  }

 private:
  static constexpr int k(int i) { return i % Basis::support[0]; }
  static constexpr int l(int i) { return i / Basis::support[0]; }

  LineWeights<Basis::degree, Basis::support[0]> along_;
  LineWeights<Basis::degree, Basis::support[1]> across_;
};

/// A nodal vector field around the cells of a block.
template <class Basis>
struct NodesOfCells {
  Lanes at[2][Basis::nodes];

  NodesOfCells(const Basis& basis, const Block& block, double* const field[2]) {
    for (int c : {0, 1})
      unroll<Basis::nodes>([&](int i) { at[c][i] = load(field[c] + block.first_node + basis.offset(i)); });
  }
};

}  // namespace mpm::MPM_ISA
