#pragma once

#include "solver/incompressible/space/velocity_space.hpp"

namespace mpm::incompressible {

/// The functions of both axes that are not zero at a particle, for a space of degree K.
template <int K>
struct ParticleWeights {
  using Full = Eigen::Matrix<double, K + 1, 1>;
  using Less = Eigen::Matrix<double, K, 1>;

  int cell_x, cell_y;
  Full x_full, y_full;  // of S_k
  Less x_less, y_less;  // of S_{k-1}

  ParticleWeights(const VelocitySpace& space, const Vec2& x)
      : ParticleWeights(space, PlaceInCell(space.axis(0), x.x()), PlaceInCell(space.axis(1), x.y())) {}

  ParticleWeights(const VelocitySpace& space, const PlaceInCell& x, const PlaceInCell& y)
      : cell_x(x.cell),
        cell_y(y.cell),
        x_full(horner<K + 1>(space.axis(0).polynomials(0, x.cell), x.xi)),
        y_full(horner<K + 1>(space.axis(1).polynomials(0, y.cell), y.xi)),
        x_less(horner<K>(space.axis(0).polynomials(1, x.cell), x.xi)),
        y_less(horner<K>(space.axis(1).polynomials(1, y.cell), y.xi)) {}

  /// The field at the particle [m/s]: u = sum N_i(x) M_j(y) u_ij, v = sum M_i(x) N_j(y) v_ij.
  [[nodiscard]] Vec2 velocity(const VelocityField& field) const {
    return {x_full.dot(field.u.template block<K + 1, K>(cell_x, cell_y) * y_less),
            x_less.dot(field.v.template block<K, K + 1>(cell_x, cell_y) * y_full)};
  }

 private:
  template <int Size>
  static Eigen::Matrix<double, Size, 1> horner(const double* powers, double xi) {
    using Weights = Eigen::Matrix<double, Size, 1>;
    Weights sum = Eigen::Map<const Weights>(powers);
    for (int m = 1; m < Size; ++m) sum = sum * xi + Eigen::Map<const Weights>(powers + m * Size);
    return sum;
  }
};

}  // namespace mpm::incompressible
