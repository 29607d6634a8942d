#pragma once

#include <span>
#include <variant>

#include "solver/kernel/cell_stress.hpp"

namespace mpm::MPM_ISA {

/// The fluid of a scene: which it is is asked once a pass over particles, not once a particle.
class KernelFluid {
 public:
  explicit KernelFluid(const KernelSetup& setup)
      : rheology_(setup.rheology),
        pressure_(setup.pressure),
        has_pressure_(setup.has_pressure),
        has_cell_pressure_(setup.has_cell_pressure) {}

  [[nodiscard]] bool has_cell_pressure() const { return has_cell_pressure_; }

  /// f(pressure, stress_of): stress_of(strained, stress) of a block's slots is a function of a slot's number
  /// and of a factor of its stress. One call a block sets the stresses, so that f is not compiled for every
  /// fluid. Where there are few functions, there is little to do a block and a call would be felt: there the
  /// stress of a Newtonian fluid is computed as it is asked for (newtonian_is_inlined).
  template <bool newtonian_is_inlined, class F>
  void with_stress(F&& f) const {
    with_pressure([&]<class Pressure>(const Pressure& pressure) {
      if constexpr (newtonian_is_inlined)
        if (const auto* law = std::get_if<Newtonian>(&rheology_))
          return f(pressure, [&](std::span<const Strained> strained, Stress*) {
            return [law = *law, &pressure, strained](std::size_t k, Lanes factor) {
              return mpm::MPM_ISA::stress_of(strained[k], law, pressure, factor);
            };
          });
      const StressPass<Pressure> set_stress = stress_pass_of<Pressure>(rheology_);
      f(pressure, [&](std::span<const Strained> strained, Stress* stress) {
        set_stress(rheology_, pressure, strained, stress);
        return [stress](std::size_t k, Lanes factor) { return factor * stress[k]; };
      });
    });
  }

 private:
  template <class F>
  void with_pressure(F&& f) const {
    if (has_cell_pressure_)
      f(pressure_);
    else if (has_pressure_)
      f(static_cast<const TaitPressure&>(pressure_));
    else
      f(NoPressure{});
  }

  Rheology rheology_;
  CellTaitPressure pressure_;
  bool has_pressure_, has_cell_pressure_;
};

}  // namespace mpm::MPM_ISA
