#pragma once

#include <cmath>

#include "solver/kernel/full_mass/mass_matrix.hpp"
#include "solver/kernel/full_mass/uniform_inverse.hpp"

namespace mpm::MPM_ISA {

/// Solves M x = b for both components of a nodal field at once, with prescribed values on walls, by conjugate
/// gradients (ConsistentMass, solver/transfer; solver/grid/conjugate_gradients.hpp, whose notes hold here).
template <int degree>
class MassSolve {
 public:
  MassSolve(const Lattice& lattice, const FullMassSetup& setup)
      : lattice_(lattice),
        matrix_(lattice),
        inverse_(lattice, setup.mass),
        uniform_{setup.mass[0].diagonal, setup.mass[1].diagonal},
        negligible_mass_(setup.negligible_mass),
        has_walls_(!setup.wall_nodes.empty()),
        node_(lattice),
        prescribed_(lattice),
        residual_(lattice),
        z_(lattice),
        direction_(lattice),
        product_(lattice) {
    for (const int wall : setup.wall_nodes) {
      const int count = lattice.count(0);
      wall_nodes_.push_back(wall / count * lattice.stride() + wall % count);
    }
  }

  MassMatrix<degree>& matrix() { return matrix_; }
  /// Values on wall nodes; zero elsewhere.
  double* prescribed(std::size_t c) { return prescribed_[c]; }

  /// When the matrix is complete: functions that hold next to no mass are left out, their values are zero.
  void fix_nodes() {
    const double* const m = matrix_.diagonal();
    double largest = 0;
    each_node([&](int i) { largest = std::max(largest, m[i]); });
    each_node([&](int i) { node_[free][i] = m[i] > negligible_mass_ * largest ? 1 : 0; });
    for (const int i : wall_nodes_) node_[free][i] = 0;
    for (int j = 0; j < lattice_.count(1); ++j)
      for (int k = 0; k < lattice_.count(0); ++k) {
        const int i = j * lattice_.stride() + k;
        const double t = uniform_[0][static_cast<std::size_t>(k)] * uniform_[1][static_cast<std::size_t>(j)];
        node_[scale][i] = node_[free][i] > 0 ? std::sqrt(t / m[i]) : 0;
      }
  }

  /// x <- M^-1 b, from the value that x has; b stays. Without walls the total of b is kept to round-off.
  /// `mass` is sum_p N_ip m_p.
  Balance operator()(const double* mass, LatticeVector& b, LatticeVector& x) {
    Balance balance{{sum_of(b[0]), sum_of(b[1])}, {}};
    for (std::size_t c : {0, 1})
      each_vector(
          [&](int i) { store(x[c] + i, select(is_free(i), load(x[c] + i), load(prescribed_[c] + i))); });
    iterate(b, x);
    if (!has_walls_) keep_total(balance, mass, x);
    for (std::size_t c : {0, 1}) {
      lattice_.fill_margin(x[c]);
      Lanes sum = 0;
      each_vector([&](int i) { sum += load(mass + i) * load(x[c] + i); });
      balance.found[c] = mpm::MPM_ISA::sum(sum);
    }
    return balance;
  }

 private:
  // As in solver/transfer/consistent_mass.cpp.
  static constexpr double tolerance = 1e-14;
  static constexpr int most_iterations = 200;

  /// One number a component.
  struct Both {
    double of[2];
    [[nodiscard]] bool exceeds(const Both& other) const { return of[0] > other.of[0] || of[1] > other.of[1]; }
    /// A component that is solved stays as it is.
    [[nodiscard]] Both over(const Both& other) const {
      const auto quotient = [](double a, double b) { return b > 0 ? a / b : 0; };
      return {{quotient(of[0], other.of[0]), quotient(of[1], other.of[1])}};
    }
  };

  void iterate(LatticeVector& b, LatticeVector& x) {
    if (has_walls_)
      subtract_product(b, prescribed_);
    else
      for (std::size_t c : {0, 1})
        each_vector([&](int i) { store(residual_[c] + i, load(node_[free] + i) * load(b[c] + i)); });
    Both enough = precondition();
    for (double& of : enough.of) of *= tolerance * tolerance;
    subtract_product(b, x);
    Both size = precondition();
    for (std::size_t c : {0, 1}) each_vector([&](int i) { store(direction_[c] + i, load(z_[c] + i)); });
    for (int iteration = 0; iteration < most_iterations && size.exceeds(enough); ++iteration) {
      const Both step = size.over(multiply_direction());
      for (std::size_t c : {0, 1})
        each_vector([&](int i) {
          store(x[c] + i, load(x[c] + i) + step.of[c] * load(direction_[c] + i));
          store(residual_[c] + i, load(residual_[c] + i) - step.of[c] * load(product_[c] + i));
        });
      const Both next = precondition(), turn = next.over(size);
      for (std::size_t c : {0, 1})
        each_vector(
            [&](int i) { store(direction_[c] + i, load(z_[c] + i) + turn.of[c] * load(direction_[c] + i)); });
      size = next;
    }
  }

  /// r = b - M v on free nodes.
  void subtract_product(LatticeVector& b, LatticeVector& v) {
    each_product(v, [&](int i, const Lanes(&product)[2]) {
      for (std::size_t c : {0, 1})
        store(residual_[c] + i, load(node_[free] + i) * (load(b[c] + i) - product[c]));
    });
  }

  /// q = M d on free nodes; returns d q.
  Both multiply_direction() {
    Lanes sum[2] = {0, 0};
    each_product(direction_, [&](int i, const Lanes(&product)[2]) {
      for (std::size_t c : {0, 1}) {
        const Lanes q = load(node_[free] + i) * product[c];
        store(product_[c] + i, q);
        sum[c] += q * load(direction_[c] + i);
      }
    });
    return {{mpm::MPM_ISA::sum(sum[0]), mpm::MPM_ISA::sum(sum[1])}};
  }

  /// z = P^-1 r; returns r z.
  Both precondition() {
    const double* const r[2] = {residual_[0], residual_[1]};
    double* const z[2] = {z_[0], z_[1]};
    inverse_.apply(node_[scale], r, z);
    Lanes sum[2] = {0, 0};
    for (std::size_t c : {0, 1}) each_vector([&](int i) { sum[c] += load(r[c] + i) * load(z[c] + i); });
    return {{mpm::MPM_ISA::sum(sum[0]), mpm::MPM_ISA::sum(sum[1])}};
  }

  /// f(i, M v there).
  template <class F>
  [[gnu::flatten]] void each_product(LatticeVector& v, F&& f) {
    for (std::size_t c : {0, 1}) lattice_.fill_margin(v[c]);
    const double* const of[2] = {v[0], v[1]};
    each_vector([&](int i) {
      Lanes product[2];
      matrix_.row(i, of, product);
      f(i, product);
    });
  }

  /// Adds the uniform field that makes up for what the iteration left: sum_i (M x)_i = sum_i m_i x_i.
  void keep_total(const Balance& balance, const double* mass, LatticeVector& x) {
    Lanes total = 0;
    each_vector([&](int i) { total += load(node_[free] + i) * load(mass + i); });
    for (std::size_t c : {0, 1}) {
      Lanes found = 0;
      each_vector([&](int i) { found += load(node_[free] + i) * load(mass + i) * load(x[c] + i); });
      const double missing = (balance.asked[c] - mpm::MPM_ISA::sum(found)) / mpm::MPM_ISA::sum(total);
      each_vector([&](int i) { store(x[c] + i, load(x[c] + i) + missing * load(node_[free] + i)); });
    }
  }

  [[nodiscard]] Mask is_free(int i) const { return load(node_[free] + i) > 0; }
  /// Over the nodes themselves: margins may hold anything.
  [[nodiscard]] double sum_of(const double* field) const {
    double total = 0;
    each_node([&](int i) { total += field[i]; });
    return total;
  }
  template <class F>
  void each_node(F&& f) const {
    for (int row = 0; row < lattice_.count(1); ++row)
      for (int i = row * lattice_.stride(); i < row * lattice_.stride() + lattice_.count(0); ++i) f(i);
  }
  template <class F>
  [[gnu::always_inline]] void each_vector(F&& f) const {
    lattice_.each_vector(f);
  }

  const Lattice& lattice_;
  MassMatrix<degree> matrix_;
  UniformInverse inverse_;
  std::vector<double> uniform_[2];
  double negligible_mass_;
  bool has_walls_;
  std::vector<int> wall_nodes_;
  static constexpr std::size_t free =
      0;  // one, or zero where the value is prescribed, or without mass, or margin
  static constexpr std::size_t scale =
      1;  // (T_ii/M_ii)^1/2 [m/kg^1/2], T that of the uniform fluid; 0 where not free
  LatticeFields<2> node_;
  LatticeVector prescribed_, residual_, z_, direction_, product_;
};

}  // namespace mpm::MPM_ISA
