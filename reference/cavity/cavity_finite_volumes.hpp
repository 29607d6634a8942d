#pragma once

#include <functional>
#include <vector>

#include "reference/vortices/lid_driven_cavity.hpp"

namespace reference {

/// Kinematic viscosity against the shear rate, in units of U L and U/L.
using ViscosityOfRate = std::function<double(double)>;

/// The steady flow of a generalised Newtonian fluid in a unit square whose lid, y = 1, moves with unit
/// velocity along x, by finite volumes of second order on a staggered mesh (Harlow & Welch 1965) of n x n
/// cells: central fluxes, viscosities 2 nu D at cell centres and corners, walls by mirror images. Solved by
/// successive substitution of the convecting velocity and the viscosity, each time with a direct solve of
/// velocity and pressure together.
class CavityFiniteVolumes {
 public:
  /// Starts from another mesh's solution where one is given. Throws std::runtime_error where the iteration
  /// does not come to rest.
  CavityFiniteVolumes(const ViscosityOfRate& viscosity, int cells,
                      const CavityFiniteVolumes* coarser = nullptr);

  /// u (component 0) or v (1) at a point of the unit square, by cubic interpolation between its places on the
  /// mesh, mirrored at walls.
  [[nodiscard]] double velocity(int component, double x, double y) const;

 private:
  friend class CavityEquations;
  int cells_;
  std::vector<double> u_, v_;  // (n + 1) x n and n x (n + 1), x fastest
};

/// The centre lines u(1/2, y) and v(x, 1/2) at the places of marchi_2009(), with the uncertainty of each.
struct CavityLine {
  CavityPoint point;   ///< its value extrapolated to h = 0
  double uncertainty;  ///< distance between the extrapolation of the two finer meshes and that of the two
                       ///< coarser
};

/// By Richardson extrapolation with the formal order 2 from meshes of n, 2 n and 4 n cells.
std::vector<CavityLine> cavity_centre_lines(const ViscosityOfRate& viscosity, int coarsest);

}  // namespace reference
