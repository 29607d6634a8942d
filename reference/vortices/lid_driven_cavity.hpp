#pragma once

#include <vector>

namespace reference {

/// One velocity component of the steady flow in a unit square whose lid, y = 1, moves with unit velocity
/// along x.
struct CavityPoint {
  double x, y;    ///< [side]
  int component;  ///< 0: u, 1: v
  double value;   ///< [lid's velocity]
};

/// The centre lines u(1/2, y) and v(x, 1/2) at 15 places each, for Re = U L/nu of 100, 400 and 1000; empty
/// for any other. Source: C.H. Marchi, R. Suero, L.K. Araki, "The lid-driven square cavity flow: numerical
/// solution with a 1024 x 1024 grid", J. Braz. Soc. Mech. Sci. Eng. 31 (2009) 186-198, Tables: second-order
/// finite volumes on meshes to 1024 x 1024 with multiple Richardson extrapolation. The digits beyond the ones
/// that the authors hold certain (some 6) are kept as printed. Ghia, Ghia & Shin 1982 are off by up to 3e-3.
std::vector<CavityPoint> marchi_2009(double reynolds);

}  // namespace reference
