#pragma once

#include "solver/incompressible/lanes/plane_mass.hpp"
#include "solver/incompressible/lanes/stencil_rows.hpp"

namespace mpm::MPM_ISA {

/// The fit of one component, of nx x ny functions a cell: (P + r M) U = loads + r M U_last, with the
/// particles' consistent mass P, which the exact mass M of the uniform fluid resembles: conjugate gradients
/// with that as preconditioner need some dozen iterations whatever the mesh, more where cells have run thin.
template <int nx, int ny>
class ComponentFit {
 public:
  ComponentFit(const PlaneSetup& setup, int component)
      : rows_(setup, component),
        mass_(rows_, setup.axis[0].factor[component == 0 ? 0 : 1],
              setup.axis[1].factor[component == 0 ? 1 : 0]),
        held_(rows_),
        matrix_(rows_),
        load_(rows_) {
    held_.set_uniform(setup.axis[0].mass[component == 0 ? 0 : 1].data(),
                      setup.axis[1].mass[component == 0 ? 1 : 0].data(), setup.regularisation);
  }

  void clear() {
    matrix_.copy(held_);
    load_.clear();
  }
  /// As StencilRows::add(); the loads of function (k, l) of a cell at [l * nx + k].
  [[gnu::always_inline]] void add(int i, int j, const CellSums<nx, ny>& sums, const Lanes (&loads)[nx * ny]) {
    matrix_.add(i, j, sums);
    double* const begin = load_.data() + j * rows_.stride() + i;
    for (int k = 0; k < nx; ++k)
      for (int l = 0; l < ny; ++l) {
        double* const at = begin + l * rows_.stride() + k;
        store(at, load(at) + loads[l * nx + k]);
      }
  }

  /// As PlaneKernel::solve().
  [[gnu::flatten]] void solve(double tolerance, const double* last, double* result) const {
    constexpr int most_iterations = 400;
    FunctionArray x(rows_), r(rows_), z(rows_), p(rows_), product(rows_);
    PlaneMass::Scratch scratch = mass_.scratch();
    const auto multiply = [&](const StencilRows<nx, ny>& matrix, FunctionArray& of) {
      rows_.set_images(of.data());
      matrix.multiply(of.data(), product.data());
      rows_.fold(product.data());
    };
    const auto precondition = [&] {
      mass_.solve(r.data(), z.data(), scratch);
      return dot(r, z);
    };
    rows_.place(last, x.data());
    multiply(held_, x);
    r.copy(load_);
    rows_.fold(r.data());
    add_scaled(r, 1, product);
    const double enough = tolerance * tolerance * precondition();
    multiply(matrix_, x);
    add_scaled(r, -1, product);
    double rz = precondition();
    p.copy(z);
    for (int k = 0; k < most_iterations && !(rz <= enough); ++k) {
      multiply(matrix_, p);
      const double alpha = rz / dot(p, product);
      add_scaled(x, alpha, p);
      add_scaled(r, -alpha, product);
      const double next = precondition();
      rows_.each_vector(
          [&, by = next / rz](int i) { store(p.data() + i, load(z.data() + i) + by * load(p.data() + i)); });
      rz = next;
    }
    rows_.collect(x.data(), result);
  }

  [[nodiscard]] const FunctionRows& rows() const { return rows_; }

 private:
  /// Over unknowns; images, where only one has them, count as nothing.
  [[nodiscard]] double dot(const FunctionArray& a, const FunctionArray& b) const {
    Lanes total = 0;
    rows_.each_vector([&](int i) { total += load(a.data() + i) * load(b.data() + i); });
    return sum(total);
  }
  void add_scaled(FunctionArray& to, double factor, const FunctionArray& of) const {
    rows_.each_vector(
        [&](int i) { store(to.data() + i, load(to.data() + i) + factor * load(of.data() + i)); });
  }

  FunctionRows rows_;
  PlaneMass mass_;
  StencilRows<nx, ny> held_, matrix_;
  FunctionArray load_;
};

}  // namespace mpm::MPM_ISA
