#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/linear_algebra.hpp"
#include "solver/scene.hpp"

namespace mpm {

/// One direction of the background grid for basis functions of a given polynomial degree: `cells` cells of
/// size h. A periodic direction has as many functions as cells; between walls there are cells + degree (open
/// knots).
class Axis {
 public:
  Axis(double length, int cells, bool periodic, int degree)
      : length(length), h(length / cells), inverse_h(cells / length), cells(cells), periodic(periodic) {
    const int functions = periodic ? cells : cells + degree;
    for (int k = 0; k < cells + degree; ++k) function_.push_back(periodic ? k % cells : k);
    count_ = functions;
  }

  [[nodiscard]] int count() const { return count_; }
  /// Number of the k-th function counted along the axis, 0 <= k < cells + degree: periodic images share one.
  [[nodiscard]] int function(int k) const { return function_[static_cast<std::size_t>(k)]; }
  /// The cell that holds coordinate x; a point on the far end belongs to the last cell.
  [[nodiscard]] int cell_of(double x) const {
    return std::clamp(static_cast<int>(x * inverse_h), 0, cells - 1);
  }

  /// Cell corners along the axis, each once.
  [[nodiscard]] int corners() const { return periodic ? cells : cells + 1; }
  [[nodiscard]] double corner(int i) const { return i == cells ? length : i * h; }

  /// Brings a coordinate back into a periodic direction; false when it lies outside or is not finite.
  bool contain(double& x) const {
    if (x >= 0 && x <= length) return true;
    if (!periodic || !std::isfinite(x)) return false;
    x -= length * std::floor(x / length);
    return x >= 0 && x <= length;
  }

  double length, h, inverse_h;
  int cells;
  bool periodic;

 private:
  std::vector<int> function_;
  int count_ = 0;
};

/// Nodal fields on the background grid. Index of a node: j * x.count() + i.
struct Grid {
  Grid(const Scene& scene, int degree)
      : x(scene.size.x(), scene.cells[0], scene.periodic(0), degree),
        y(scene.size.y(), scene.cells[1], scene.periodic(1), degree) {
    const auto n = static_cast<std::size_t>(x.count()) * static_cast<std::size_t>(y.count());
    mass.assign(n, 0);
    velocity.assign(n, Vec2::Zero());
    force.assign(n, Vec2::Zero());
    acceleration.assign(n, Vec2::Zero());
    mapped.assign(n, Vec2::Zero());
  }

  [[nodiscard]] std::size_t size() const { return mass.size(); }

  Axis x, y;
  ScalarField mass;          ///< m_i [kg/m]
  VectorField velocity;      ///< v_i: momentum while it is being summed, then velocity [m/s]
  VectorField force;         ///< f_i: internal and body force per unit depth [N/m]
  VectorField acceleration;  ///< a_i [m/s2]
  VectorField mapped;        ///< velocity of the updated particles mapped back (MUSL) [m/s]
};

}  // namespace mpm
