#pragma once

#include <vector>

#include "solver/linear_algebra.hpp"

namespace mpm {

/// What a simulation is besides where its grid, not its particles, has the pressure.
class PressureField {
 public:
  virtual ~PressureField() = default;
  /// Pressure at points at the time reached, of mean zero over the domain [Pa]; empty before the first step,
  /// and where the fluid's viscosity varies.
  [[nodiscard]] virtual std::vector<double> grid_pressure(const VectorField& points) const = 0;
};

}  // namespace mpm
