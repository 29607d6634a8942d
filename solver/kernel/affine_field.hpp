#pragma once

#include "solver/kernel/cell_weights.hpp"

namespace mpm::MPM_ISA {

// Particles that carry an affine field v_p + C_p (x - x_p) (Apic, solver/transfer/transfer.hpp). Here C times
// the size of a cell stands for C: the change of the velocity across a cell.

/// Place of the control point of the k-th function along axis a, in cells from where the cells begin.
template <class Basis, bool is_uniform>
Lanes control_place(const Block& block, int a, int k) {
  if constexpr (Basis::degree == 1 || is_uniform)
    return k - 0.5 * (Basis::degree - 1);
  else
    return block.functions[a][(Basis::degree + 1) * (Basis::degree + 1) + k];
}

/// v_p + C_p (x_i - x_p) at the nodes of the cells, with x_i their control points: linear in them.
template <class Basis, bool is_uniform>
class AffineVelocity {
 public:
  AffineVelocity(const Block& block, const Slot& p, const Affine& affine) {
    for (int c : {0, 1}) {
      const Lanes* change = affine.c[c];
      Lanes at_origin = p.v[c] - change[0] * p.s[0];
      across_[c][0] = 0;
      if constexpr (rows > 1) {
        at_origin = at_origin - change[1] * p.s[1];
        unroll<rows>(
            [&](int l) { across_[c][l] = change[1] * control_place<Basis, is_uniform>(block, 1, l); });
      }
      unroll<columns>([&](int k) {
        along_[c][k] = at_origin + change[0] * control_place<Basis, is_uniform>(block, 0, k);
      });
    }
  }

  /// Component c at the i-th node.
  [[nodiscard]] Lanes at(int c, int i) const { return along_[c][i % columns] + across_[c][i / columns]; }

 private:
  static constexpr int columns = Basis::support[0], rows = Basis::support[1];
  Lanes along_[2][columns], across_[2][rows];
};

/// What makes C of nodal values along one axis, sum_k M_k u_k: M_k = N_k (x_k - x_p)/D with
/// D = sum_k N_k (x_k - x_p)^2, and the slopes dN_k/dx for the linear basis and where D vanishes, on a wall.
/// On a uniform grid D = h^2/4 for quadratic splines, wherever the particle is.
template <int degree, int support, bool is_uniform>
struct LineMoments {
  Lanes moment[support];

  /// place(k): of the k-th control point, s: of the particles
  template <class Place>
  LineMoments(const LineWeights<degree, support, is_uniform>& n, Lanes s, [[maybe_unused]] double inverse_h,
              const Place& place) {
    if constexpr (support == 1) {  // nothing varies along this axis
      moment[0] = 0;
    } else if constexpr (degree == 1) {
      moment[0] = -1;
      moment[1] = 1;
    } else if constexpr (is_uniform) {
      static_assert(degree == 2);
      unroll<support>([&](int k) { moment[k] = 4 * n.value[k] * (place(k) - s); });
    } else {
      Lanes d = 0;
      unroll<support>([&](int k) {
        const Lanes offset = place(k) - s;
        moment[k] = n.value[k] * offset;
        d += moment[k] * offset;
      });
      const Mask is_inside = d > 1e-12;
      const Lanes inverse_d = 1 / select(is_inside, d, 1);
      unroll<support>(
          [&](int k) { moment[k] = select(is_inside, inverse_d * moment[k], n.slope[k] * (1 / inverse_h)); });
    }
  }
};

/// The same of the functions of a cell, along and across the lanes.
template <class Basis, bool is_uniform>
struct TensorMoments {
  LineMoments<Basis::degree, Basis::support[0], is_uniform> along;
  LineMoments<Basis::degree, Basis::support[1], is_uniform> across;

  TensorMoments(const Basis& basis, const Block& block, const Slot& p,
                const TensorWeights<Basis, is_uniform>& n_p)
      : along(n_p.along, p.s[0], basis.inverse_h[0],
              [&](int k) { return control_place<Basis, is_uniform>(block, 0, k); }),
        across(n_p.across, p.s[1], basis.inverse_h[1],
               [&](int l) { return control_place<Basis, is_uniform>(block, 1, l); }) {}
};

/// The bilinear field in a cell, a + b s + c t + d s t, tells its slopes by itself.
struct BilinearMoments {
  template <class... Whatever>
  BilinearMoments(const Whatever&...) {}
};

template <class Basis, bool is_uniform>
using CellMoments = std::conditional_t<Basis::is_bilinear, BilinearMoments, TensorMoments<Basis, is_uniform>>;

}  // namespace mpm::MPM_ISA
