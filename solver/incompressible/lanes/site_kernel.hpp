#pragma once

#include <array>
#include <memory>
#include <vector>

#include "solver/material/rheology.hpp"

namespace mpm {

// The interface to the vector kernels of viscosities that vary, plain data as in plane_kernel.hpp.

/// The Gauss points of a plane's cells, k + 1 along an axis in each, and the functions of degree k there.
struct SiteSetup {
  int degree;
  std::array<int, 2> cells;
  /// By axis and derivative (values, slopes [1/m], curvatures [1/m2]): of function a at point g of cell c at
  /// (c (k + 1) + g)(k + 1) + a.
  std::array<std::array<std::vector<double>, 3>, 2> functions;
  std::array<std::vector<double>, 2> weights;  ///< by axis: of point g of cell c at c (k + 1) + g [m]
};

/// Integrals of a stream function's strain rate over all cells. Fields at sites are arrays of size() numbers
/// in the kernel's own order, some of which, of weight zero, belong to no site. A stream function, or sums
/// over its functions, is an array over all functions, x fastest.
class SiteKernel {
 public:
  virtual ~SiteKernel() = default;

  [[nodiscard]] virtual int size() const = 0;
  [[nodiscard]] virtual const double* weights() const = 0;  ///< [m2]
  /// psi_xy and psi_yy - psi_xx [1/s].
  virtual void rates(const double* psi, double* xy, double* shear) const = 0;
  /// Adds, for every function N, the sum over sites of of_xy N_xy + of_shear (N_yy - N_xx).
  virtual void add_forces(const double* of_xy, const double* of_shear, double* sums) const = 0;

  /// take(context, cell along x, along y, entries, pitch): of the functions m = a + (k + 1) b, n of a cell,
  /// the entry (m, n), m <= n, at (n (n + 1)/2 + m) pitch.
  using TakeBlock = void (*)(void* context, int cell_x, int cell_y, const double* entries, int pitch);
  /// For every cell, its sums over sites of c_xx N_xy N'_xy + c_xs (N_xy N'_s + N_s N'_xy) + c_ss N_s N'_s
  /// with N_s = N_yy - N_xx.
  virtual void tangents(const double* c_xx, const double* c_xs, const double* c_ss, TakeBlock take,
                        void* context) const = 0;
};

/// Viscosities [Pa s] of a fluid at many gdot^2 = 2 D:D [1/s2].
using FlowCurve = void (*)(const Rheology& fluid, int count, const double* gdot_squared, double* viscosity);

}  // namespace mpm
