#pragma once

#include <algorithm>
#include <vector>

#include "solver/sph/pairs/pair_loops.hpp"
#include "solver/sph/sph_scheme.hpp"

namespace mpm::sph {

/// Radial smoothing kernels of the plane, normalised to one, in units of the smoothing length: q = r/h.
/// Quintic spline (Morris, Fox & Zhu 1997, Eq. 12; support 3), cubic spline (Monaghan 1992; support 2).
struct Profile {
  double support;                  ///< q beyond which the kernel vanishes
  double (*value)(double q);       ///< h^2 W
  double (*slope_by_q)(double q);  ///< h^4 W'(r)/r = (1/q) d(h^2 W)/dq, finite at q = 0, never positive
};
const Profile& profile_of(SphScheme::Kernel kernel);

/// A function of r^2, tabulated up to the support and interpolated linearly: neither root nor quotient in a
/// pair loop. What interpolation changes (below 1e-6 of the value at the centre) the lattice's moments, which
/// are taken from the table itself, make up for.
class RadialTable {
 public:
  static constexpr int intervals = 2048;

  template <class Function>
  RadialTable(double radius, const Function& of_squared) : scale_(intervals / (radius * radius)) {
    points_.resize(intervals + 2);
    double here = of_squared(0.0);
    for (int k = 0; k < intervals; ++k) {
      const double next = k + 1 == intervals ? 0.0 : of_squared((k + 1) / scale_);
      points_[static_cast<std::size_t>(k)] = {here, next - here};
      here = next;
    }
  }

  /// Zero from the support on.
  double operator()(double r_squared) const {
    const double place = std::min(r_squared * scale_, static_cast<double>(intervals));
    const int k = static_cast<int>(place);
    const Point& point = points_[static_cast<std::size_t>(k)];
    return point.value + (place - k) * point.difference;
  }

  /// For the vector loops: valid as long as the table.
  [[nodiscard]] RadialPoints points() const { return {scale_, intervals, &points_.front().value}; }

  void multiply(double factor) {
    for (Point& point : points_) point = {factor * point.value, factor * point.difference};
  }

 private:
  struct Point {
    double value = 0, difference = 0;
  };
  static_assert(sizeof(Point) == 2 * sizeof(double));
  double scale_;
  std::vector<Point> points_;
};

/// Kernel of one smoothing length on one lattice: W and F = W'(r)/r <= 0, so that the gradient is F (x_i -
/// x_j). Both are scaled so that sums over the lattice are exact where integrals would be: sum V W = 1 for
/// constants, sum V F y^2 = -1 for gradients of linear and Laplacians of quadratic fields. Left as they are,
/// these sums differ from one by a number that depends on h/spacing alone, a floor that no refinement lowers.
struct SmoothingKernel {
  SmoothingKernel(SphScheme::Kernel kernel, double smoothing_length, double spacing_x, double spacing_y);

  double radius;           ///< support [m]
  RadialTable weight;      ///< W [1/m2]
  RadialTable gradient;    ///< F [1/m4]
  double weight_moment;    ///< sum V W before it was scaled
  double gradient_moment;  ///< -sum V F y^2 before it was scaled
};

}  // namespace mpm::sph
