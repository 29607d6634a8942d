#include "solver/viscosity/implicit_viscosity.hpp"

#include "solver/viscosity/viscous_newton.hpp"
#include "solver/viscosity/yield_newton.hpp"

namespace mpm {

std::unique_ptr<ImplicitViscosity> make_implicit_viscosity(const Rheology& rheology, const Grid& grid,
                                                           const WallNodes& walls) {
  return std::visit(
      [&]<class Law>(const Law& law) -> std::unique_ptr<ImplicitViscosity> {
        if constexpr (std::is_same_v<Law, HerschelBulkley>)
          return std::make_unique<YieldNewton>(law, grid, walls);
        else
          return std::make_unique<ViscousNewton<Law>>(law, grid, walls);
      },
      rheology);
}

}  // namespace mpm
