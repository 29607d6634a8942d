#pragma once

#include <cmath>

#include "solver/kernel/full_mass/mass_matrix.hpp"
#include "solver/kernel/full_mass/uniform_inverse.hpp"

namespace mpm::MPM_ISA {

/// Solves M x = b for both components of a nodal field at once, with prescribed values on walls, by conjugate
/// gradients (ConsistentMass, solver/transfer; solver/grid/matrices/conjugate_gradients.hpp, whose notes hold
/// here).
class MassSolve {
 public:
  /// With the mass of a uniform fluid, and the nodes whose values are prescribed (FullMassSetup).
  MassSolve(const Lattice& lattice, const Bands& bands, const LatticeMatrix& matrix,
            const std::array<LineMass, 2>& line, const std::vector<int>& walls, double negligible_mass)
      : lattice_(lattice),
        bands_(bands),
        matrix_(matrix),
        inverse_(lattice, line),
        negligible_mass_(negligible_mass),
        has_walls_(!walls.empty()),
        node_(lattice),
        prescribed_(lattice),
        residual_(lattice),
        z_(lattice),
        direction_(lattice),
        product_(lattice) {
    for (int j = 0; j < lattice.count(1); ++j)
      for (int k = 0; k < lattice.count(0); ++k)
        node_[uniform][j * lattice.stride() + k] =
            line[0].diagonal[static_cast<std::size_t>(k)] * line[1].diagonal[static_cast<std::size_t>(j)];
    for (const int wall : walls) node_[uniform][lattice.place_of(wall)] = 0;
  }

  /// Values on walls' nodes; zero elsewhere.
  double* prescribed(std::size_t c) { return prescribed_[c]; }
  /// Of all solves.
  [[nodiscard]] long iterations() const { return iterations_; }

  /// When the matrix is complete: functions that hold next to no mass are left out, their values are zero.
  /// `mass` is sum_p N_ip m_p.
  void fix_nodes(const double* mass) {
    const double* const m = matrix_.diagonal();
    const double negligible = negligible_mass_ * largest_of(m);
    const Both of_free_nodes = bands_.sum([&](int i, Lanes(&sum)[2]) {
      const Lanes m_ii = load(m + i), t_ii = load(node_[uniform] + i);
      const Mask is_free = (t_ii > 0) & (m_ii > negligible);
      store(node_[free] + i, select(is_free, 1, 0));
      store(node_[scale] + i, select(is_free, sqrt(t_ii / select(is_free, m_ii, 1)), 0));
      sum[0] += select(is_free, load(mass + i), 0);
    });
    free_mass_ = of_free_nodes.of[0];
  }

  /// x <- M^-1 b, from the value that x has; b stays. Without walls the total of b is kept to round-off. What
  /// a solution is added to need not be known better than that is: the residual r ends with r P^-1 r below
  /// 1e-28 (x M x + beside), `beside` the square y M y of that other field, or 0.
  Balance operator()(const double* mass, const LatticeVector& b, LatticeVector& x, const Both& beside) {
    // Beyond the last node of a row b is zero.
    const Both asked = bands_.sum_with_margins(x, [&](int i, Lanes(&sum)[2]) {
      for (std::size_t c : {0, 1}) {
        sum[c] += load(b[c] + i);
        store(x[c] + i, select(is_free(i), load(x[c] + i), load(prescribed_[c] + i)));
      }
    });
    iterate(b, x, beside);
    const Both missing = has_walls_ ? Both{{0, 0}} : missing_velocity(asked, mass, x);
    const Both found = bands_.sum_with_margins(x, [&](int i, Lanes(&sum)[2]) {
      for (std::size_t c : {0, 1}) {
        const Lanes mended = load(x[c] + i) + missing.of[c] * load(node_[free] + i);
        store(x[c] + i, mended);
        sum[c] += load(mass + i) * mended;
      }
    });
    return {{asked.of[0], asked.of[1]}, {found.of[0], found.of[1]}};
  }

 private:
  // As in solver/transfer/consistent_mass.cpp.
  static constexpr double tolerance = 1e-14;
  static constexpr int most_iterations = 200;

  static bool exceeds(const Both& a, const Both& b) { return a.of[0] > b.of[0] || a.of[1] > b.of[1]; }
  /// A component that is solved stays as it is.
  static Both over(const Both& a, const Both& b) {
    const auto quotient = [](double p, double q) { return q > 0 ? p / q : 0; };
    return {{quotient(a.of[0], b.of[0]), quotient(a.of[1], b.of[1])}};
  }

  void iterate(const LatticeVector& b, LatticeVector& x, const Both& beside) {
    // Of the solution x + M^-1 r: x M x + 2 x r + r M^-1 r.
    Both enough = begin_residual(b, x);
    Both size = precondition();
    for (int c : {0, 1})
      enough.of[c] = tolerance * tolerance * (std::max(enough.of[c], 0.0) + size.of[c] + beside.of[c]);
    turn({{0, 0}});
    // Once at least: a forecast that is near enough by itself would be what the next ones are made from, and
    // their errors would add up.
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      if (iteration > 0 && !exceeds(size, enough)) break;
      advance(over(size, multiply_direction()), x);
      const Both next = precondition();
      turn(over(next, size));
      size = next;
      ++iterations_;
    }
  }

  // What changes the residual sums it along its rows for precondition(), too.

  /// r = b - M x on free nodes; returns x M x + 2 x r.
  Both begin_residual(const LatticeVector& b, const LatticeVector& x) {
    return bands_.sum_of_rows([&](Rows rows, Lanes(&sum)[2]) {
      matrix_.multiply(rows, x, product_);
      lattice_.each_vector(rows, [&](int i) {
        for (std::size_t c : {0, 1}) {
          const Lanes product = load(product_[c] + i);
          const Lanes r = load(node_[free] + i) * (load(b[c] + i) - product);
          store(residual_[c] + i, r);
          sum[c] += load(x[c] + i) * (product + 2 * r);
        }
      });
      inverse_.sum_along(rows, node_[scale], residual_);
    });
  }

  /// q = M d on free nodes; returns d q.
  Both multiply_direction() {
    return bands_.sum_of_rows([&](Rows rows, Lanes(&sum)[2]) {
      matrix_.multiply(rows, direction_, product_);
      lattice_.each_vector(rows, [&](int i) {
        for (std::size_t c : {0, 1}) {
          const Lanes q = load(node_[free] + i) * load(product_[c] + i);
          store(product_[c] + i, q);
          sum[c] += q * load(direction_[c] + i);
        }
      });
    });
  }

  /// x += step d, r -= step q.
  void advance(const Both& step, LatticeVector& x) {
    bands_.each_rows([&](Rows rows) {
      lattice_.each_vector(rows, [&](int i) {
        for (std::size_t c : {0, 1}) {
          store(x[c] + i, load(x[c] + i) + step.of[c] * load(direction_[c] + i));
          store(residual_[c] + i, load(residual_[c] + i) - step.of[c] * load(product_[c] + i));
        }
      });
      inverse_.sum_along(rows, node_[scale], residual_);
    });
  }

  /// z = P^-1 r; returns r z.
  Both precondition() {
    return bands_.sum_of_rows([&](Rows rows, Lanes(&sum)[2]) {
      inverse_.sum_across(rows, node_[scale], [&](int i, const Lanes(&z)[2]) {
        for (std::size_t c : {0, 1}) {
          store(z_[c] + i, z[c]);
          sum[c] += load(residual_[c] + i) * z[c];
        }
      });
    });
  }

  /// d = z + by d, with its margin.
  void turn(const Both& by) {
    bands_.each_vector_with_margins(direction_, [&](int i) {
      for (std::size_t c : {0, 1})
        store(direction_[c] + i, load(z_[c] + i) + by.of[c] * load(direction_[c] + i));
    });
  }

  /// The uniform field that makes up for what the iteration left: sum_i (M x)_i = sum_i m_i x_i.
  Both missing_velocity(const Both& asked, const double* mass, const LatticeVector& x) const {
    const Both found = bands_.sum([&](int i, Lanes(&sum)[2]) {
      for (std::size_t c : {0, 1}) sum[c] += load(mass + i) * load(x[c] + i);
    });
    return over({{asked.of[0] - found.of[0], asked.of[1] - found.of[1]}}, {{free_mass_, free_mass_}});
  }

  [[nodiscard]] Mask is_free(int i) const { return load(node_[free] + i) > 0; }
  /// Over the nodes themselves: the margin holds images.
  [[nodiscard]] double largest_of(const double* field) const {
    std::vector<double> of_row(static_cast<std::size_t>(lattice_.count(1)));
    bands_.each_rows([&](Rows rows) {
      for (int row = rows.begin; row < rows.end; ++row) {
        const double* const begin = field + row * lattice_.stride();
        of_row[static_cast<std::size_t>(row)] = *std::max_element(begin, begin + lattice_.count(0));
      }
    });
    return *std::max_element(of_row.begin(), of_row.end());
  }

  const Lattice& lattice_;
  const Bands& bands_;
  const LatticeMatrix& matrix_;
  UniformInverse inverse_;
  double negligible_mass_;
  bool has_walls_;
  double free_mass_ = 0;  // of the nodes that are free [kg/m]
  long iterations_ = 0;
  static constexpr std::size_t free = 0;   // one; zero where prescribed, or without mass, or beyond the nodes
  static constexpr std::size_t scale = 1;  // (T_ii/M_ii)^1/2 [m/kg^1/2] where free, else zero
  static constexpr std::size_t uniform =
      2;  // T_ii, of a fluid of unit density [m2]; zero where not free ever
  LatticeFields<3> node_;
  LatticeVector prescribed_, residual_, z_, direction_, product_;
};

}  // namespace mpm::MPM_ISA
