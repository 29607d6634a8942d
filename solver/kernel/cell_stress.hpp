#pragma once

#include <span>
#include <variant>

#include "solver/kernel/cells/cells.hpp"

namespace mpm::MPM_ISA {

/// Strain rate of a slot's particles [1/s]: du_0/dx_0, du_1/dx_1, du_0/dx_1 + du_1/dx_0; density [kg/m3],
/// where it varies.
struct Strained {
  Lanes d_00, d_11, shear, density;
};

/// factor sigma with sigma = 2 mu D - (2/3 mu tr D + P) I (paper Eqs. 21 to 25).
template <class Law, class Pressure>
Stress stress_of(const Strained& p, const Law& law, const Pressure& pressure, Lanes factor) {
  Lanes mu;
  if constexpr (Law::needs_shear_rate)
    mu = law.viscosity(2 * (p.d_00 * p.d_00 + p.d_11 * p.d_11) + p.shear * p.shear);
  else
    mu = law.viscosity();
  Lanes isotropic = -(2.0 / 3.0) * mu * (p.d_00 + p.d_11);
  if constexpr (Pressure::varies) isotropic = isotropic - pressure.pressure(p.density);
  isotropic = factor * isotropic;
  mu = factor * mu;
  return {2 * mu * p.d_00 + isotropic, 2 * mu * p.d_11 + isotropic, mu * p.shear};
}

/// Sets the stress of the slots of a block [Pa], whatever their basis: a function, so that passes need not be
/// compiled for every fluid.
template <class Pressure>
using StressPass = void (*)(const Rheology&, const Pressure&, std::span<const Strained>, Stress*);
template <class Pressure>
StressPass<Pressure> stress_pass_of(const Rheology& rheology) {
  return std::visit(
      []<class Law>(const Law&) -> StressPass<Pressure> {
        return [](const Rheology& of, const Pressure& pressure, std::span<const Strained> strained,
                  Stress* stress) {
          const Law law = *std::get_if<Law>(&of);
          for (const Strained& p : strained) *stress++ = stress_of(p, law, pressure, 1);
        };
      },
      rheology);
}

}  // namespace mpm::MPM_ISA
