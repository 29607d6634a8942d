#pragma once

#include "solver/incompressible/lanes/function_fit.hpp"
#include "solver/incompressible/lanes/stencil_rows.hpp"

namespace mpm::MPM_ISA {

/// The fit of one component, of nx x ny functions a cell: what cells add to it.
template <int nx, int ny>
class ComponentFit {
 public:
  ComponentFit(const PlaneSetup& setup, int component)
      : fit_(setup, component), held_(rows()), matrix_(rows()) {
    held_.set_uniform(setup.axis[0].mass[component == 0 ? 0 : 1].data(),
                      setup.axis[1].mass[component == 0 ? 1 : 0].data(), setup.regularisation);
  }

  void clear() {
    matrix_.copy(held_);
    fit_.load_of_particles().clear();
  }
  /// As StencilRows::add(); the loads of function (k, l) of a cell at [l * nx + k].
  [[gnu::always_inline]] void add(int i, int j, const CellSums<nx, ny>& sums, const Lanes (&loads)[nx * ny]) {
    matrix_.add(i, j, sums);
    double* const begin = fit_.load_of_particles().data() + j * rows().stride() + i;
    for (int k = 0; k < nx; ++k)
      for (int l = 0; l < ny; ++l) {
        double* const at = begin + l * rows().stride() + k;
        store(at, load(at) + loads[l * nx + k]);
      }
  }

  /// As PlaneKernel::solve().
  void solve(double tolerance, const double* last, double* result) const {
    fit_.solve(held_, matrix_, tolerance, last, result);
  }

  [[nodiscard]] const FunctionRows& rows() const { return fit_.rows(); }

 private:
  FunctionFit fit_;
  StencilRows<nx, ny> held_, matrix_;
};

}  // namespace mpm::MPM_ISA
