#pragma once

#include <Eigen/Core>

#include "solver/material/rheology.hpp"

namespace mpm {

/// Viscosities [Pa s], or squared shear rates [1/s2], of as many particles as are treated at once.
using ViscosityBlock = Eigen::Array<double, 32, 1>;

/// The viscosity of a fluid for blocks of particles: which law it follows is asked once a block.
class BlockViscosity {
 public:
  explicit BlockViscosity(const Rheology& rheology);

  /// Whether the viscosity depends on the shear rate.
  [[nodiscard]] bool varies() const { return varies_; }
  /// Of a fluid whose viscosity does not vary, and 0 for others.
  [[nodiscard]] double constant() const { return constant_; }
  /// mu from gdot^2 = 2 D:D; for fluids whose viscosity varies.
  [[nodiscard]] ViscosityBlock operator()(const ViscosityBlock& gdot_squared) const;

 private:
  Rheology rheology_;
  bool varies_;
  double constant_;
};

}  // namespace mpm
