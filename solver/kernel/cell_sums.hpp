#pragma once

#include <array>

#include "solver/kernel/affine_field.hpp"
#include "solver/kernel/cell_weights.hpp"

namespace mpm::MPM_ISA {

/// Transpose of CellField: what the particles of a block bring to the nodes of their cells of
/// momentum, sum_p N_ip m_p v_p, and before it, if asked for, of mass, sum_p N_ip m_p. Of particles with an
/// affine field v_p is its value at the node.
template <class Basis, bool with_mass>
class MomentumSums {
 public:
  static constexpr int fields = with_mass ? 3 : 2;

  template <class Weights>
  void add(const Weights& n_p, Lanes m, const Lanes (&v)[2]) {
    n_p.values_times(m, [&](int i, Lanes n_m) {
      if constexpr (with_mass) sum_[0][i] += n_m;
      sum_[fields - 2][i] += n_m * v[0];
      sum_[fields - 1][i] += n_m * v[1];
    });
  }

  template <class Weights>
  void add(const Weights& n_p, Lanes m, const AffineVelocity<Basis, Weights::is_uniform>& v) {
    n_p.values_times(m, [&](int i, Lanes n_m) {
      if constexpr (with_mass) sum_[0][i] += n_m;
      sum_[fields - 2][i] += n_m * v.at(0, i);
      sum_[fields - 1][i] += n_m * v.at(1, i);
    });
  }

  /// Of a field, at the nodes of the cells.
  [[nodiscard]] const auto& at_nodes(const Basis&, int field) const { return sum_[field]; }

 private:
  Lanes sum_[fields][Basis::nodes] = {};
};

/// Transpose of CellGradient: sum_p Q_p grad N_ip of a symmetric tensor Q, two components.
template <class Basis>
class DivergenceSums {
 public:
  static constexpr int fields = 2;

  template <class Weights>
  void add(const Weights& n_p, const Stress& q) {
    if constexpr (Basis::is_bilinear) {
      const Lanes q_0[2] = {q.s_00, q.s_01}, q_1[2] = {q.s_01, q.s_11};
      for (int c : {0, 1}) {
        sum_[c][0] += q_0[c];
        sum_[c][1] += q_0[c] * n_p.t;
        sum_[c][2] += q_1[c];
        sum_[c][3] += q_1[c] * n_p.s;
      }
    } else {
      add_tensor_products(n_p, q);
    }
  }

  /// Of a field, at the nodes of the cells.
  [[nodiscard]] decltype(auto) at_nodes(const Basis& basis, int field) const {
    const auto& sum = sum_[field];
    if constexpr (Basis::is_bilinear) {
      // dN/dx_0 is -(1 - t), 1 - t, -t, t over h_0, dN/dx_1 is -(1 - s), -s, 1 - s, s over h_1.
      const Lanes along_1 = basis.inverse_h[0] * sum[1], along_0 = basis.inverse_h[0] * sum[0] - along_1;
      const Lanes across_1 = basis.inverse_h[1] * sum[3], across_0 = basis.inverse_h[1] * sum[2] - across_1;
      return std::array{0 - along_0 - across_0, along_0 - across_1, across_0 - along_1, along_1 + across_1};
    } else {
      return (sum);
    }
  }

 private:
  template <class Weights>
  void add_tensor_products(const Weights& n_p, const Stress& q) {
    constexpr int columns = Basis::support[0], rows = Basis::support[1];
    unroll<rows>([&](int l) {
      const Lanes n = n_p.across.value[l], dn = n_p.across.slope[l];
      const Lanes n_00 = n * q.s_00, n_01 = n * q.s_01, dn_01 = dn * q.s_01, dn_11 = dn * q.s_11;
      unroll<columns>([&](int k) {
        // A product at a time: each is one operation with its sum.
        Lanes &sum_0 = sum_[0][l * columns + k], &sum_1 = sum_[1][l * columns + k];
        sum_0 += n_00 * n_p.along.slope[k];
        sum_0 += dn_01 * n_p.along.value[k];
        sum_1 += n_01 * n_p.along.slope[k];
        sum_1 += dn_11 * n_p.along.value[k];
      });
    });
  }

  /// At the nodes; of the bilinear basis the sums of Q_c0, Q_c0 t, Q_c1, Q_c1 s.
  Lanes sum_[fields][Basis::nodes] = {};
};

}  // namespace mpm::MPM_ISA
