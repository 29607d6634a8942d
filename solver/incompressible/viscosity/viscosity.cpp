#include "solver/incompressible/viscosity/viscosity.hpp"

#include "solver/incompressible/viscosity/newtonian_viscosity.hpp"
#include "solver/incompressible/viscosity/shear_viscosity.hpp"

namespace mpm::incompressible {

std::unique_ptr<Viscosity> make_viscosity(const Scene& scene, const VelocitySpace& space,
                                          const SparseMatrix& basis, const SparseMatrix& mass,
                                          const WallShares& shares) {
  const double density = scene.fluid.density;
  if (const auto* newtonian = std::get_if<Newtonian>(&scene.fluid.rheology))
    return std::make_unique<NewtonianViscosity>(scene, space, basis, mass, newtonian->viscosity() / density,
                                                shares);
  const FlowLaw law = flow_law(scene.fluid.rheology, density);
  switch (space.degree()) {
    case 2:
      return std::make_unique<ShearViscosity<2>>(scene, space, mass, law, shares);
    case 3:
      return std::make_unique<ShearViscosity<3>>(scene, space, mass, law, shares);
    default:
      return std::make_unique<ShearViscosity<4>>(scene, space, mass, law, shares);
  }
}

}  // namespace mpm::incompressible
