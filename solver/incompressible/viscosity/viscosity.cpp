#include "solver/incompressible/viscosity/viscosity.hpp"

#include "solver/incompressible/viscosity/newtonian_viscosity.hpp"
#include "solver/incompressible/viscosity/shear_viscosity.hpp"
#include "solver/incompressible/viscosity/yield_viscosity.hpp"

namespace mpm::incompressible {
namespace {

template <int K>
std::unique_ptr<Viscosity> make(const Scene& scene, const VelocitySpace& space, const SparseMatrix& mass,
                                const WallShares& shares) {
  if (const auto* yielding = std::get_if<HerschelBulkley>(&scene.fluid.rheology))
    return std::make_unique<YieldViscosity<K>>(scene, space, mass, *yielding, shares);
  return std::make_unique<ShearViscosity<K>>(scene, space, mass,
                                             FlowLaw(scene.fluid.rheology, scene.fluid.density), shares);
}

}  // namespace

std::unique_ptr<Viscosity> make_viscosity(const Scene& scene, const VelocitySpace& space,
                                          const SparseMatrix& basis, const SparseMatrix& mass,
                                          const WallShares& shares) {
  const double density = scene.fluid.density;
  if (const auto* newtonian = std::get_if<Newtonian>(&scene.fluid.rheology))
    return std::make_unique<NewtonianViscosity>(scene, space, basis, mass, newtonian->viscosity() / density,
                                                shares);
  switch (space.degree()) {
    case 2:
      return make<2>(scene, space, mass, shares);
    case 3:
      return make<3>(scene, space, mass, shares);
    default:
      return make<4>(scene, space, mass, shares);
  }
}

}  // namespace mpm::incompressible
