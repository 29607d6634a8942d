#pragma once

#include <vector>

#include "solver/incompressible/space/velocity_space.hpp"
#include "solver/incompressible/viscosity/viscous_form.hpp"
#include "solver/kernel/isa.hpp"

namespace mpm::incompressible {

/// A Gauss point on a wall, and the k + 1 x k + 1 functions of its cell there.
struct WallSite {
  using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 5, 5>;

  int cell_x, cell_y;
  Block xy, shear;  ///< what functions do to psi_xy, to psi_yy - psi_xx [1/m2]
  Block along;      ///< to the velocity along the wall, u = psi_y or v = -psi_x [1/m]
  double weight;    ///< [m]
  const Side* side;
  int across;    ///< axis
  double sign;   ///< of the outward normal
  double holds;  ///< [1/m]
  double moves;  ///< share of the side's velocity

  /// The coefficients of its cell's functions.
  template <class Matrix>
  [[nodiscard]] auto in(Matrix& functions) const {
    return functions.block(cell_x, cell_y, along.rows(), along.cols());
  }
  [[nodiscard]] double of(const MatrixXd& psi, const Block& derivative) const {
    return in(psi).cwiseProduct(derivative).sum();
  }
};

/// Of all sides that walls hold: by side, cell and point, those of a cell in a row. The scene must outlive
/// them.
std::vector<WallSite> wall_sites(const Scene& scene, const VelocitySpace& space, const WallShares& shares);

/// The (k + 1)^2 Gauss points of every cell for the vector kernel.
SiteSetup site_setup(const VelocitySpace& space);

}  // namespace mpm::incompressible
