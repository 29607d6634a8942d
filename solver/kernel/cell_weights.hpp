#pragma once

#include <type_traits>

#include "solver/kernel/cells/cells.hpp"

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

  /// Whether the functions of a uniform grid away from walls are written out, which costs less than
  /// polynomials from memory.
  static constexpr bool has_uniform_form = degree == 2;

  /// Whether u(x) in a cell is a + b s + c t + d s t with s, t in [0, 1): few operations beside a sum over
  /// nodes.
  static constexpr bool is_bilinear = degree == 1 && !is_strip;
};

/// N and dN/dx of one axis, in the cells of a block: values [-] and slopes [1/m]. `is_uniform`: in blocks
/// that say so (Block::is_uniform).
template <int degree, int support, bool is_uniform>
struct LineWeights {
  Lanes value[support], slope[support];

  LineWeights(Lanes s, double inverse_h, [[maybe_unused]] const Lanes* polynomials) {
    if constexpr (support == 1) {  // nothing varies along this axis
      value[0] = 1;
      slope[0] = 0;
    } else if constexpr (degree == 1) {
      value[0] = 1 - s;
      value[1] = s;
      slope[0] = -inverse_h;
      slope[1] = inverse_h;
    } else if constexpr (is_uniform) {
      static_assert(degree == 2);
      const Lanes r = 1 - s;
      value[0] = 0.5 * r * r;
      value[1] = 0.5 + s * r;
      value[2] = 0.5 * s * s;
      slope[0] = -inverse_h * r;
      slope[2] = inverse_h * s;
      slope[1] = 0 - slope[0] - slope[2];
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

/// N_ip and grad N_ip of the particles of a slot at the nodes i of their cells: products of one function
/// along and one across the lanes.
template <class Basis, bool is_of_uniform_grid = false>
struct TensorWeights {
  static constexpr int columns = Basis::support[0], rows = Basis::support[1];
  static constexpr bool is_uniform = is_of_uniform_grid;
  LineWeights<Basis::degree, columns, is_uniform> along;
  LineWeights<Basis::degree, rows, is_uniform> across;

  /// s: their places in the cells
  TensorWeights(const Basis& basis, const Block& block, const Lanes s[2])
      : along(s[0], basis.inverse_h[0], block.functions[0]),
        across(s[1], basis.inverse_h[1], block.functions[1]) {}

  /// visit(i, q N_i)
  template <class Visit>
  void values_times(Lanes q, Visit&& visit) const {
    unroll<rows>([&](int l) {
      const Lanes q_l = q * across.value[l];
      unroll<columns>([&](int k) { visit(l * columns + k, q_l * along.value[k]); });
    });
  }
};

/// The same of the bilinear basis (1 - s)(1 - t), s (1 - t), (1 - s) t, s t: nothing but places in the cell.
struct BilinearWeights {
  static constexpr bool is_uniform = false;
  Lanes s, t;

  template <class Basis>
  BilinearWeights(const Basis&, const Block&, const Lanes place[2]) : s(place[0]), t(place[1]) {}

  template <class Visit>
  void values_times(Lanes q, Visit&& visit) const {
    const Lanes q_1 = q * t, q_0 = q - q_1, q_01 = q_0 * s, q_11 = q_1 * s;
    visit(0, q_0 - q_01);
    visit(1, q_01);
    visit(2, q_1 - q_11);
    visit(3, q_11);
  }
};

template <class Basis>
using CellWeights = std::conditional_t<Basis::is_bilinear, BilinearWeights, TensorWeights<Basis>>;

/// f(weights of a slot) of what makes them in a block: a function of the places of its particles.
template <class Basis, class F>
[[gnu::always_inline]] inline void with_weights(const Basis& basis, const Block& block, F&& f) {
  if constexpr (Basis::has_uniform_form)
    if (block.is_uniform)
      return f([&](const Lanes s[2]) { return TensorWeights<Basis, true>(basis, block, s); });
  f([&](const Lanes s[2]) { return CellWeights<Basis>(basis, block, s); });
}

}  // namespace mpm::MPM_ISA
