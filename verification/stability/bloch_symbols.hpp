#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/scene/scheme.hpp"

namespace verification {

/// A periodic lattice of square cells (side 1), each holding the same particles.
struct ParticleLattice {
  std::array<int, 2> per_cell{2, 2};
  bool gauss = false;                  ///< Gauss-Legendre points and weights, else evenly spaced
  std::array<double, 2> offset{0, 0};  ///< of all particles from their seats in the cells [cells]

  /// Offsets beyond which the lattice repeats itself, along either axis [cells].
  [[nodiscard]] std::array<double, 2> period() const;
};

/// What transfers and forces do to one Bloch wave u_j = u exp(i theta . j) of nodal vectors on the lattice:
/// every operator between particles and grid becomes a number or a 2 x 2 matrix. Units: cell side, reference
/// density and cell mass one. B-splines of uniform knots, evaluated here and not by the solver, which this
/// is to check.
struct BlochSymbols {
  double consistent_mass;     ///< sum_p m_p |N_p|^2, between 0 and 1 (the lumped mass)
  double remap;               ///< P2G after G2P of a nodal field, lumped mass, without affine fields
  double affine_remap;        ///< the same with them (APIC)
  Eigen::Matrix2cd viscous;   ///< K: nodal force -nu K u of sigma/rho = nu (L + L^T - 2/3 tr L)
  Eigen::Matrix2cd dilation;  ///< Q: q -> q - dt Q u, where c^2 q is the nodal force of the densities
};

/// Symbols at a wavenumber [rad a cell]; a zero component means that nothing varies that way.
BlochSymbols bloch_symbols(mpm::Scheme::Basis basis, const ParticleLattice& lattice,
                           const std::array<double, 2>& theta);

}  // namespace verification
