#pragma once

#include "solver/linear_algebra.hpp"

namespace mpm {

/// The material points, one entry a particle in every array. Quantities per unit depth where mass appears.
struct Particles {
  VectorField position;      ///< x_p [m]
  VectorField velocity;      ///< v_p [m/s]
  ScalarField mass;          ///< m_p [kg/m], constant
  ScalarField density;       ///< rho_p [kg/m3]
  std::vector<Mat2> stress;  ///< Cauchy stress sigma_p [Pa]
  std::vector<Mat2> affine;  ///< velocity gradient that particles of APIC (C_p), and compressible ones of
                             ///< full mass, carry [1/s]

  [[nodiscard]] std::size_t size() const { return mass.size(); }
};

}  // namespace mpm
