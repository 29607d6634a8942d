#include "solver/material/block_viscosity.hpp"

#include <variant>

namespace mpm {

namespace {

template <class Law>
constexpr bool depends_on_shear(const Law&) {
  return Law::needs_shear_rate;
}

}  // namespace

BlockViscosity::BlockViscosity(const Rheology& rheology)
    : rheology_(rheology),
      varies_(std::visit([](const auto& law) { return depends_on_shear(law); }, rheology)),
      constant_(varies_ ? 0 : std::get<Newtonian>(rheology).viscosity()) {}

ViscosityBlock BlockViscosity::operator()(const ViscosityBlock& gdot_squared) const {
  return std::visit(
      [&]<class Law>(const Law& law) -> ViscosityBlock {
        if constexpr (Law::needs_shear_rate)
          return law.viscosity(gdot_squared);
        else
          return ViscosityBlock::Constant(law.viscosity());
      },
      rheology_);
}

}  // namespace mpm
