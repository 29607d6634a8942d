#include "solver/viscosity/implicit_viscosity.hpp"

#include "solver/viscosity/viscous_newton.hpp"

namespace mpm {

std::unique_ptr<ImplicitViscosity> make_implicit_viscosity(const Rheology& rheology, const Grid& grid,
                                                           const WallNodes& walls) {
  return std::visit(
      [&]<class Law>(const Law& law) -> std::unique_ptr<ImplicitViscosity> {
        return std::make_unique<ViscousNewton<Law>>(law, grid, walls);
      },
      rheology);
}

}  // namespace mpm
