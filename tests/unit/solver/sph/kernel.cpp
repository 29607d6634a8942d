#include <algorithm>
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

TEST_CASE("as rows slide, viscous sums of the cubic kernel vary by 1.6 %, of the quintic by 0.13 %",
          "[sph]") {
  const double dx = 1e-4;
  const auto variation = [&](SphScheme::Kernel kind, double ratio) {
    const sph::SmoothingKernel kernel(kind, ratio * dx, dx, dx);
    double least = 2, most = 0;
    for (const double slide : {0.0, 0.25, 0.5}) {
      double sum = 0;  // of grad^2 (y^2/2) over the lattice, every other row slid
      for (int j = -8; j <= 8; ++j)
        for (int i = -8; i <= 8; ++i) {
          const double x = i + (j % 2 != 0 ? slide : 0.0);
          sum -= dx * dx * kernel.gradient((x * x + j * j) * dx * dx) * (j * dx) * (j * dx);
        }
      least = std::min(least, sum);
      most = std::max(most, sum);
    }
    CHECK(least < 1);
    CHECK(most > 1);
    return most - least;
  };
  CHECK(variation(SphScheme::Kernel::Cubic, 1.3) == Approx(0.01625).epsilon(0.01));
  CHECK(variation(SphScheme::Kernel::Quintic, 1.0) == Approx(0.00127).epsilon(0.02));
}
