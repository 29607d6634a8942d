#pragma once

#include "solver/make_solver.hpp"
#include "solver/solver.hpp"

namespace mpm {

/// Every transfer on one basis.
template <class Basis>
std::unique_ptr<Simulation> make_solver_on(const Scene& scene, const Scheme& scheme) {
  const auto make = [&]<class Transfer>(const Transfer& transfer) -> std::unique_ptr<Simulation> {
    return std::make_unique<Solver<Basis, Transfer>>(scene, scheme, transfer);
  };
  switch (scheme.transfer) {
    case Scheme::Transfer::Flip:
      return make(Flip{});
    case Scheme::Transfer::Pic:
      return make(Pic{});
    case Scheme::Transfer::FlipBlend:
      return make(FlipBlend{scheme.flip_fraction});
    case Scheme::Transfer::Apic:
      return make(Apic{});
    case Scheme::Transfer::FullMass:
      return make(FullMass{});
  }
  throw SceneError("a transfer has no solver");
}

/// B-splines of one degree: on the strip where the scene is one periodic cell wide, in two dimensions
/// elsewhere.
template <int degree>
std::unique_ptr<Simulation> make_solver_of_degree(const Scene& scene, const Scheme& scheme) {
  if (scene.periodic(0) && scene.cells[0] == 1) return make_solver_on<StripBSpline<degree>>(scene, scheme);
  return make_solver_on<BSpline<degree>>(scene, scheme);
}

}  // namespace mpm
