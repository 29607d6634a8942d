#include "solver/sph/smoothing_kernel.hpp"

#include <cmath>
#include <numbers>

namespace mpm::sph {
namespace {

constexpr double quintic_norm = 7 / (478 * std::numbers::pi);
constexpr double cubic_norm = 10 / (7 * std::numbers::pi);

double power(double x, int n) {
  double product = 1;
  for (int i = 0; i < n; ++i) product *= x;
  return product;
}

/// sum_k c_k max(a_k - q, 0)^n, the truncated powers of the quintic spline.
double truncated(double q, int n) {
  double sum = power(std::max(3 - q, 0.0), n) - 6 * power(std::max(2 - q, 0.0), n);
  return sum + 15 * power(std::max(1 - q, 0.0), n);
}

double quintic(double q) {
  return quintic_norm * truncated(q, 5);
}
/// For q < 1 the powers are multiplied out, since their quotient by q is 0/0 at the centre.
double quintic_slope_by_q(double q) {
  if (q >= 1) return -5 * quintic_norm * truncated(q, 4) / q;
  return quintic_norm * (-120 + q * q * (120 - 50 * q));
}

double cubic(double q) {
  if (q < 1) return cubic_norm * (1 + q * q * (-1.5 + 0.75 * q));
  return q < 2 ? cubic_norm * 0.25 * power(2 - q, 3) : 0;
}
double cubic_slope_by_q(double q) {
  if (q < 1) return cubic_norm * (-3 + 2.25 * q);
  return q < 2 ? -cubic_norm * 0.75 * power(2 - q, 2) / q : 0;
}

struct Moments {
  double weight, gradient;
};

/// Sums over a lattice whose rows, or columns, have slid past each other by any amount (averaged over eight):
/// that is what shear does to it.
Moments lattice_moments(const SmoothingKernel& kernel, double dx, double dy) {
  constexpr int slides = 8;
  Moments sum{0, 0};
  for (const bool rows : {true, false}) {
    const double along = rows ? dx : dy, across = rows ? dy : dx;
    const int far_along = 2 + static_cast<int>(kernel.radius / along);
    const int far_across = 1 + static_cast<int>(kernel.radius / across);
    for (int slide = 0; slide < slides; ++slide)
      for (int j = -far_across; j <= far_across; ++j)
        for (int i = -far_along; i <= far_along; ++i) {
          const double y = j * across;
          const double x = (i + (j == 0 ? 0.0 : static_cast<double>(slide) / slides)) * along;
          sum.weight += dx * dy * kernel.weight(x * x + y * y);
          sum.gradient -= dx * dy * kernel.gradient(x * x + y * y) * y * y;
        }
  }
  return {sum.weight / (2 * slides), sum.gradient / (2 * slides)};
}

}  // namespace

const Profile& profile_of(SphScheme::Kernel kernel) {
  static const Profile quintic_profile{3, quintic, quintic_slope_by_q};
  static const Profile cubic_profile{2, cubic, cubic_slope_by_q};
  return kernel == SphScheme::Kernel::Quintic ? quintic_profile : cubic_profile;
}

SmoothingKernel::SmoothingKernel(SphScheme::Kernel kernel, double h, double spacing_x, double spacing_y)
    : radius(profile_of(kernel).support * h),
      weight(radius, [&](double r2) { return profile_of(kernel).value(std::sqrt(r2) / h) / (h * h); }),
      gradient(radius, [&](double r2) {
        return profile_of(kernel).slope_by_q(std::sqrt(r2) / h) / (h * h * h * h);
      }) {
  const Moments moments = lattice_moments(*this, spacing_x, spacing_y);
  weight_moment = moments.weight;
  gradient_moment = moments.gradient;
  weight.multiply(1 / weight_moment);
  gradient.multiply(1 / gradient_moment);
}

}  // namespace mpm::sph
