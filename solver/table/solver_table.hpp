#pragma once

#include "solver/lanes/full_mass_solver.hpp"
#include "solver/lanes/lane_solver.hpp"
#include "solver/step/solver.hpp"
#include "solver/table/make_solver.hpp"

namespace mpm {

/// The part of its velocity that a particle keeps.
inline double flip_of(const Scheme& scheme) {
  if (scheme.transfer == Scheme::Transfer::Flip) return 1;
  return scheme.transfer == Scheme::Transfer::FlipBlend ? scheme.flip_fraction : 0;
}

/// Every transfer on one basis, particle by particle.
template <class Basis>
std::unique_ptr<Simulation> make_general_solver_on(const Scene& scene, const Scheme& scheme) {
  const auto make = [&]<class Transfer>(const Transfer& transfer) -> std::unique_ptr<Simulation> {
    return std::make_unique<Solver<Basis, Transfer>>(scene, scheme, transfer);
  };
  switch (scheme.transfer) {
    case Scheme::Transfer::Flip:
    case Scheme::Transfer::Pic:
    case Scheme::Transfer::FlipBlend:
      return make(FlipPic(flip_of(scheme)));
    case Scheme::Transfer::Apic:
      return make(Apic{});
    case Scheme::Transfer::FullMass:
      return make(FullMass{});
  }
  throw SceneError("a transfer has no solver");
}

/// On the vector kernels where they cover scene and scheme.
template <class Basis>
std::unique_ptr<Simulation> make_solver_on(const Scene& scene, const Scheme& scheme, int threads) {
  if (lanes_cover(scene, scheme))
    return std::make_unique<LaneSolver<Basis>>(scene, scheme, flip_of(scheme), threads);
  if constexpr (Basis::X::support == Basis::Y::support)  // a plane
    if (full_mass_lanes_cover<Basis>(scene, scheme))
      return std::make_unique<FullMassSolver<Basis>>(scene, scheme, threads);
  return make_general_solver_on<Basis>(scene, scheme);
}

/// B-splines of one degree: on the strip where the scene is one periodic cell wide, in two dimensions
/// elsewhere.
template <int degree>
std::unique_ptr<Simulation> make_solver_of_degree(const Scene& scene, const Scheme& scheme, int threads) {
  if (scene.periodic(0) && scene.cells[0] == 1)
    return make_solver_on<StripBSpline<degree>>(scene, scheme, threads);
  return make_solver_on<BSpline<degree>>(scene, scheme, threads);
}

}  // namespace mpm
