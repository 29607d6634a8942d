#pragma once

#include <Eigen/Core>
#include <complex>

#include "solver/scene/scheme.hpp"
#include "verification/stability/bloch_symbols.hpp"

namespace verification {

/// Which waves take part. Shear: velocity across the wavenumber, viscosity alone. Longitudinal: velocity
/// along it, density, and 4/3 of the viscosity. Both vary along y only. Plane: every wave of the plane, with
/// the whole stress.
enum class Waves { Shear, Longitudinal, Plane };
std::string name(Waves waves);
/// Throws ConfigError for an unknown name.
Waves waves_named(const std::string& text);

/// A time step in units of the lattice.
struct StepSize {
  double r = 0;    ///< nu dt/h^2
  double cfl = 0;  ///< c dt/h; 0: no pressure
};

/// Of three fields of two components at most: no allocation.
using Amplification = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

/// Amplification matrix of one time step for a Bloch wave on particles frozen on their lattice, about rest or
/// about uniform motion, in a fluid of uniform density (von Neumann analysis). Unknowns: the nodal velocity u
/// that P2G makes of the particles, the nodal force q of their densities over c^2, and where a stepping keeps
/// the stress of the step before its viscous nodal force. Nothing is lost by these: the grid feels particles
/// through u and q alone, and what they hide from it keeps its size (factor one for FLIP, its fraction for a
/// blend, zero else), so that the eigenvalues left out never exceed one.
Amplification amplification_matrix(const mpm::Scheme& scheme, const BlochSymbols& symbols, Waves waves,
                                   const StepSize& step);

/// Largest modulus of an eigenvalue.
double spectral_radius(const Amplification& matrix);

/// Whether the spectral radius exceeds 1 + allowance: without eigenvalues where powers of the matrix tell.
bool grows(const Amplification& matrix, double allowance);

}  // namespace verification
