#include <cmath>
#include <numbers>

#include "solver/sph/smoothing_kernel.hpp"
#include "solver/sph/stable_sph_step.hpp"
#include "tests/catch.hpp"

using namespace mpm;

TEST_CASE("SPH kernels are normalised in the plane, and their slopes are their derivatives", "[sph]") {
  for (const SphScheme::Kernel kind : {SphScheme::Kernel::Quintic, SphScheme::Kernel::Cubic}) {
    INFO(name(kind));
    const sph::Profile& profile = sph::profile_of(kind);
    constexpr int n = 30000;  // the midpoint rule is exact to (support/n)^2
    double integral = 0, second_moment = 0;
    for (int i = 0; i < n; ++i) {
      const double q = (i + 0.5) * profile.support / n, dq = profile.support / n;
      integral += 2 * std::numbers::pi * q * profile.value(q) * dq;
      // the integral of F y^2 over the plane, which the gradient of a linear field asks to be -1
      second_moment += std::numbers::pi * q * q * q * profile.slope_by_q(q) * dq;
      const double step = 1e-5, slope = (profile.value(q + step) - profile.value(q - step)) / (2 * step);
      if (i % 100 == 50) CHECK(std::abs(q * profile.slope_by_q(q) - slope) < 1e-7);
    }
    CHECK(std::abs(integral - 1) < 1e-7);
    CHECK(std::abs(second_moment + 1) < 1e-7);
    CHECK(profile.value(profile.support) == 0);
    CHECK(profile.slope_by_q(profile.support) == 0);
    CHECK(profile.slope_by_q(0) == Approx(profile.slope_by_q(1e-9)));
  }
}

TEST_CASE("SPH sums over a lattice are exact for constants and for linear fields", "[sph]") {
  const double dx = 1e-4;
  for (const double ratio : {1.0, 1.3, 2.0}) {
    const sph::SmoothingKernel kernel(SphScheme::Kernel::Quintic, ratio * dx, dx, dx);
    double weights = 0, moment = 0;
    for (int j = -8; j <= 8; ++j)
      for (int i = -8; i <= 8; ++i) {
        const double r2 = (i * i + j * j) * dx * dx;
        weights += dx * dx * kernel.weight(r2);
        moment -= dx * dx * kernel.gradient(r2) * (j * dx) * (j * dx);
      }
    // The moments are means over rows that have slid; one lattice is off by what the kernel aliases.
    CHECK(std::abs(weights - 1) < 1e-3);
    CHECK(std::abs(moment - 1) < 3e-3);
    CHECK(kernel.gradient(9.01 * ratio * ratio * dx * dx) == 0);
  }
}
