#include "solver/incompressible/viscosity/viscosity.hpp"

#include "solver/incompressible/viscosity/newtonian_viscosity.hpp"
#include "solver/incompressible/viscosity/yield_viscosity.hpp"

namespace mpm::incompressible {

std::unique_ptr<Viscosity> make_viscosity(const Scene& scene, const VelocitySpace& space,
                                          const SparseMatrix& basis, const SparseMatrix& mass,
                                          const WallShares& shares) {
  const Rheology& fluid = scene.fluid.rheology;
  const double density = scene.fluid.density;
  if (const auto* newtonian = std::get_if<Newtonian>(&fluid))
    return std::make_unique<NewtonianViscosity>(scene, space, basis, mass, newtonian->viscosity() / density,
                                                shares);
  if (const auto* yielding = std::get_if<HerschelBulkley>(&fluid))
    return std::make_unique<YieldViscosity>(scene, space, mass, *yielding, shares);
  return std::make_unique<ShearViscosity>(scene, space, mass, FlowLaw(fluid, density), shares);
}

}  // namespace mpm::incompressible
