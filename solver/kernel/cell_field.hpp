#pragma once

#include "solver/kernel/affine_field.hpp"
#include "solver/kernel/cell_weights.hpp"

namespace mpm::MPM_ISA {

/// Sum over the l-th row of a cell's nodes, each times its function along the row.
template <class Basis>
Lanes along_row(const Lanes (&u)[Basis::nodes], int l, const Lanes (&function)[Basis::support[0]]) {
  Lanes sum = 0;
  unroll<Basis::support[0]>([&](int k) { sum += function[k] * u[l * Basis::support[0] + k]; });
  return sum;
}

/// A nodal field in the cells of a block, read where their particles are.
template <class Basis>
class CellField {
 public:
  CellField(const Basis& basis, const Block& block, const double* field) {
    unroll<Basis::nodes>([&](int i) { u_[i] = load(field + block.first_node + basis.offset(i)); });
    if constexpr (Basis::is_bilinear) {
      u_[3] = (u_[3] - u_[2]) - (u_[1] - u_[0]);
      u_[1] -= u_[0];
      u_[2] -= u_[0];
    }
  }

  /// u(x_p) = sum_i N_ip u_i
  template <class Weights>
  [[nodiscard]] Lanes at(const Weights& n_p) const {
    if constexpr (Basis::is_bilinear) {
      return (u_[0] + n_p.s * u_[1]) + n_p.t * (u_[2] + n_p.s * u_[3]);
    } else {
      Lanes u = 0;
      unroll<Basis::support[1]>(
          [&](int l) { u += n_p.across.value[l] * along_row<Basis>(u_, l, n_p.along.value); });
      return u;
    }
  }

  /// u(x_p), and the change across a cell along either axis of the affine field that stands for u about x_p.
  struct Affinely {
    Lanes value, change[2];
  };
  template <class Weights>
  [[nodiscard]] Affinely affinely_at(const Weights& n_p,
                                     const CellMoments<Basis, Weights::is_uniform>& m_p) const {
    if constexpr (Basis::is_bilinear) {
      const Lanes along = u_[1] + n_p.t * u_[3];
      return {(u_[0] + n_p.t * u_[2]) + n_p.s * along, {along, u_[2] + n_p.s * u_[3]}};
    } else {
      Affinely u{0, {0, 0}};
      unroll<Basis::support[1]>([&](int l) {
        const Lanes row = along_row<Basis>(u_, l, n_p.along.value);
        u.value += n_p.across.value[l] * row;
        u.change[0] += n_p.across.value[l] * along_row<Basis>(u_, l, m_p.along.moment);
        u.change[1] += m_p.across.moment[l] * row;
      });
      return u;
    }
  }

 private:
  /// At the nodes; of a bilinear field a, b, c, d of a + b s + c t + d s t.
  Lanes u_[Basis::nodes];
};

/// Gradient of a nodal field in the cells of a block, read where their particles are.
template <class Basis>
class CellGradient {
 public:
  CellGradient(const Basis& basis, const Block& block, const double* field) {
    unroll<Basis::nodes>([&](int i) { u_[i] = load(field + block.first_node + basis.offset(i)); });
    if constexpr (Basis::is_bilinear) {
      const Lanes b = u_[1] - u_[0], c = u_[2] - u_[0], d = (u_[3] - u_[2]) - b;
      u_[0] = basis.inverse_h[0] * b;
      u_[1] = basis.inverse_h[0] * d;
      u_[2] = basis.inverse_h[1] * c;
      u_[3] = basis.inverse_h[1] * d;
    }
  }

  /// grad u(x_p) = sum_i u_i grad N_ip: du/dx_0 and du/dx_1.
  struct Gradient {
    Lanes d_0, d_1;
  };
  template <class Weights>
  [[nodiscard]] Gradient at(const Weights& n_p) const {
    if constexpr (Basis::is_bilinear) {
      return {u_[0] + n_p.t * u_[1], u_[2] + n_p.s * u_[3]};
    } else {
      Gradient g{0, 0};
      unroll<Basis::support[1]>([&](int l) {
        g.d_0 += n_p.across.value[l] * along_row<Basis>(u_, l, n_p.along.slope);
        g.d_1 += n_p.across.slope[l] * along_row<Basis>(u_, l, n_p.along.value);
      });
      return g;
    }
  }

 private:
  /// At the nodes; of a bilinear field b/h_0, d/h_0, c/h_1, d/h_1.
  Lanes u_[Basis::nodes];
};

/// Both components of a nodal velocity or acceleration.
template <class Field>
struct Components {
  Field component[2];

  template <class Basis>
  Components(const Basis& basis, const Block& block, const std::array<double*, 2>& field)
      : component{{basis, block, field[0]}, {basis, block, field[1]}} {}

  const Field& operator[](int c) const { return component[c]; }
};
template <class Basis>
using CellVelocity = Components<CellField<Basis>>;
template <class Basis>
using CellVelocityGradient = Components<CellGradient<Basis>>;

}  // namespace mpm::MPM_ISA
