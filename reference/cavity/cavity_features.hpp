#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace reference {

/// One number of a steady cavity: a velocity on a centre line, or an extremum, or where it lies.
struct CavityFeature {
  std::string
      quantity;  ///< u, v (at x, y); u_min, v_max, v_min, psi_min (at x, y); x or y behind these: where
  double x, y;   ///< [side]
  double value;  ///< [lid's velocity], times side for psi, [side] for places
};

/// Any solution in the unit square under a lid of unit velocity.
struct CavityFlow {
  std::function<std::array<double, 2>(double, double)> velocity;
  std::function<double(double, double)> stream;
};

/// u(1/2, y) and v(x, 1/2) at the places of Marchi, Suero & Araki 2009, k/16, and of Ghia, Ghia & Shin 1982;
/// the least u and the greatest and least v on these lines with their places; the middle of the primary
/// vortex, where the fluid is at rest, and the stream function there. The same list, in the same order, for
/// any flow. NaN where an extremum is not found.
std::vector<CavityFeature> cavity_features(const CavityFlow& flow);

}  // namespace reference
