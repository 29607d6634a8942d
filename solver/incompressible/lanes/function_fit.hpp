#pragma once

#include "solver/incompressible/lanes/function_matrix.hpp"
#include "solver/incompressible/lanes/plane_mass.hpp"

namespace mpm::MPM_ISA {

/// The fit of one component: (P + r M) U = loads + r M U_last, with the particles' consistent mass P, which
/// the exact mass M of the uniform fluid resembles: conjugate gradients with that as preconditioner need some
/// dozen iterations whatever the mesh, more where cells have run thin.
class FunctionFit {
 public:
  FunctionFit(const PlaneSetup& setup, int component)
      : rows_(setup, component),
        mass_(rows_, setup.axis[0].factor[component == 0 ? 0 : 1],
              setup.axis[1].factor[component == 0 ? 1 : 0]),
        load_(rows_) {}

  [[nodiscard]] const FunctionRows& rows() const { return rows_; }
  [[nodiscard]] FunctionArray& load_of_particles() { return load_; }

  /// As PlaneKernel::solve(), with r M and P + r M.
  void solve(const FunctionMatrix& held, const FunctionMatrix& matrix, double tolerance, const double* last,
             double* result) const {
    constexpr int most_iterations = 400;
    FunctionArray x(rows_), r(rows_), z(rows_), p(rows_), product(rows_);
    PlaneMass::Scratch scratch = mass_.scratch();
    const auto multiply = [&](const FunctionMatrix& by, FunctionArray& of) {
      rows_.set_images(of.data());
      by.multiply(of.data(), product.data());
      rows_.fold(product.data());
    };
    const auto precondition = [&] {
      mass_.solve(r.data(), z.data(), scratch);
      return dot(r, z);
    };
    rows_.place(last, x.data());
    multiply(held, x);
    r.copy(load_);
    rows_.fold(r.data());
    add_scaled(r, 1, product);
    const double enough = tolerance * tolerance * precondition();
    multiply(matrix, x);
    add_scaled(r, -1, product);
    double rz = precondition();
    p.copy(z);
    for (int k = 0; k < most_iterations && !(rz <= enough); ++k) {
      multiply(matrix, p);
      const double alpha = rz / dot(p, product);
      add_scaled(x, alpha, p);
      add_scaled(r, -alpha, product);
      const double next = precondition();
      turn(p, next / rz, z);
      rz = next;
    }
    rows_.collect(x.data(), result);
  }

 private:
  /// Over unknowns; images, where only one has them, count as nothing.
  [[nodiscard, gnu::flatten]] double dot(const FunctionArray& a, const FunctionArray& b) const {
    Lanes total = 0;
    rows_.each_vector([&](int i) { total += load(a.data() + i) * load(b.data() + i); });
    return sum(total);
  }
  [[gnu::flatten]] void add_scaled(FunctionArray& to, double factor, const FunctionArray& of) const {
    rows_.each_vector(
        [&](int i) { store(to.data() + i, load(to.data() + i) + factor * load(of.data() + i)); });
  }
  /// p = z + factor p
  [[gnu::flatten]] void turn(FunctionArray& p, double factor, const FunctionArray& z) const {
    rows_.each_vector([&](int i) { store(p.data() + i, load(z.data() + i) + factor * load(p.data() + i)); });
  }

  FunctionRows rows_;
  PlaneMass mass_;
  FunctionArray load_;  // of every function, sum_p V_p N_ip u_p
};

}  // namespace mpm::MPM_ISA
