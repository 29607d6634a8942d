#include "reference/channel/newtonian_channel.hpp"

#include <cmath>
#include <limits>

#include "tests/catch.hpp"

using namespace reference;

namespace {

constexpr double kHeight = 1e-3, kNu = 1e-6, kForce = 8e-3, kPlate = 1e-4;
constexpr double kPoiseuilleMaximum = kForce * kHeight * kHeight / (8.0 * kNu);

NewtonianChannel channel(double force, double plate) {
  return NewtonianChannel({kHeight, kNu, force, plate});
}

}  // namespace

TEST_CASE("Newtonian channel: Fourier and image series are the same function") {
  // Both are exact; what differs is round-off of at most some twenty terms of the size of the scale.
  for (double tau : {0.01, 0.02, 0.05, 0.09, 0.0999, 0.1, 0.1001, 0.12, 0.2, 0.5, 1.0}) {
    const double t = tau * kHeight * kHeight / kNu;
    for (int i = 0; i <= 64; ++i) {
      const double y = kHeight * i / 64;
      CHECK(std::abs(poiseuille_fourier(y, t, kHeight, kNu, kForce) -
                     poiseuille_images(y, t, kHeight, kNu, kForce)) < 1e-13 * kPoiseuilleMaximum);
      CHECK(std::abs(couette_fourier(y, t, kHeight, kNu, kPlate) -
                     couette_images(y, t, kHeight, kNu, kPlate)) < 1e-13 * kPlate);
      CHECK(std::abs(poiseuille_fourier_gradient(y, t, kHeight, kNu, kForce) -
                     poiseuille_images_gradient(y, t, kHeight, kNu, kForce)) <
            1e-13 * 4 * kPoiseuilleMaximum / kHeight);
      // The start-up's plate gradient, 1/sqrt(pi tau) of the steady one, is the scale here.
      CHECK(std::abs(couette_fourier_gradient(y, t, kHeight, kNu, kPlate) -
                     couette_images_gradient(y, t, kHeight, kNu, kPlate)) <
            1e-13 * kPlate / kHeight * std::max(1.0, 1.0 / std::sqrt(tau)));
    }
  }
}

TEST_CASE("Newtonian channel: u_t = F + nu u_yy, and the gradient is the gradient") {
  const NewtonianChannel flow = channel(kForce, -kPlate);
  for (double t : {0.004, 0.03, 0.098, 0.11, 0.4}) {
    for (double y : {0.05e-3, 0.3e-3, 0.5e-3, 0.77e-3, 0.96e-3}) {
      // Sixth-order central differences: truncation (y/l)^6 with l the diffusion length, round-off
      // 1e-16/step.
      const auto slope = [](auto f, double x, double s) {
        return (45 * (f(x + s) - f(x - s)) - 9 * (f(x + 2 * s) - f(x - 2 * s)) +
                (f(x + 3 * s) - f(x - 3 * s))) /
               (60 * s);
      };
      const double length = std::sqrt(kNu * std::min(t, 0.1)),
                   dy = std::min(0.02 * length, 0.3 * std::min(y, kHeight - y));
      const double u_y = slope([&](double x) { return flow.velocity(x, t); }, y, dy);
      const double u_yy = slope([&](double x) { return flow.gradient(x, t); }, y, dy);
      const double u_t = slope([&](double s) { return flow.velocity(y, s); }, t, 0.006 * t);
      // Steps of 2 % of the length: 0.02^6 = 6e-11 truncation times derivatives' growth, round-off 1e-14/0.02
      // = 5e-13.
      CHECK(std::abs(u_y - flow.gradient(y, t)) < 1e-8 * kPoiseuilleMaximum / kHeight * 4);
      CHECK(std::abs(u_t - kForce - kNu * u_yy) < 1e-7 * kForce);
    }
  }
}

TEST_CASE("Newtonian channel: walls hold to the last bit, the start is at rest, the end is steady") {
  const NewtonianChannel flow = channel(kForce, kPlate);
  for (double t : {0.0, 1e-12, 1e-3, 0.0999, 0.1, 1.0, 1e6, std::numeric_limits<double>::infinity()}) {
    CHECK(flow.velocity(0.0, t) == 0.0);
    CHECK(flow.velocity(kHeight, t) == kPlate);
  }
  for (double y : {1e-9, 0.5e-3, 0.999e-3}) {
    CHECK(flow.velocity(y, 0.0) == 0.0);
    CHECK(flow.gradient(y, 0.0) == 0.0);
    const double steady = kForce / (2 * kNu) * y * (kHeight - y) + kPlate * y / kHeight;
    CHECK(flow.velocity(y, 1e4) == Approx(steady).epsilon(1e-15));
    CHECK(flow.gradient(y, 1e4) ==
          Approx(kForce / (2 * kNu) * (kHeight - 2 * y) + kPlate / kHeight).epsilon(1e-15));
  }
  CHECK(std::isinf(flow.gradient(kHeight, 0.0)));
  CHECK(channel(kForce, 0.0).gradient(kHeight, 0.0) == 0.0);
}

TEST_CASE("Newtonian channel: symmetries") {
  const NewtonianChannel plus = channel(kForce, kPlate), minus = channel(-kForce, -kPlate);
  const NewtonianChannel poiseuille = channel(kForce, 0.0), couette = channel(0.0, kPlate);
  for (double t : {1e-4, 0.05, 0.3}) {
    for (double y : {0.1e-3, 0.33e-3, 0.8e-3}) {
      CHECK(plus.velocity(y, t) == -minus.velocity(y, t));
      CHECK(plus.gradient(y, t) == -minus.gradient(y, t));
      CHECK(plus.velocity(y, t) == poiseuille.velocity(y, t) + couette.velocity(y, t));
      // Mirrored heights are rounded, so the images agree to round-off only.
      CHECK(std::abs(poiseuille.velocity(y, t) - poiseuille.velocity(kHeight - y, t)) <
            1e-15 * kPoiseuilleMaximum * 4);
    }
  }
}

TEST_CASE("Newtonian channel: the steady maximum lies inside or at the plate") {
  CHECK(channel(kForce, 0.0).steady_maximum() == Approx(1e-3).epsilon(1e-14));
  CHECK(channel(0.0, -kPlate).steady_maximum() == kPlate);
  CHECK(channel(0.0, 0.0).steady_maximum() == 0.0);
  for (double plate : {1e-4, -1e-4, 3e-3, -3e-3, 3.9e-3, 5e-3}) {
    const NewtonianChannel flow = channel(kForce, plate);
    double largest = 0.0;
    for (int i = 0; i <= 4000; ++i)
      largest = std::max(largest, std::abs(flow.velocity(kHeight * i / 4000, 1e3)));
    // Sampling misses a parabola's top by at most (1/8000)^2 of its curvature: 4 umax/8000^2 = 6e-8.
    CHECK(flow.steady_maximum() == Approx(largest).epsilon(1e-7));
    CHECK(flow.steady_maximum() >= largest * (1 - 1e-15));
  }
}

TEST_CASE("Newtonian channel: bad arguments are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(NewtonianChannel({0.0, kNu, kForce, 0.0}), std::invalid_argument);
  CHECK_THROWS_WITH(NewtonianChannel({-1.0, kNu, kForce, 0.0}), contains("height"));
  CHECK_THROWS_WITH(NewtonianChannel({kHeight, nan, kForce, 0.0}), contains("viscosity"));
  CHECK_THROWS_WITH(NewtonianChannel({kHeight, kNu, nan, 0.0}), contains("finite"));
  CHECK_THROWS_WITH(NewtonianChannel({kHeight, kNu, 0.0, 1.0 / 0.0}), contains("finite"));
  const NewtonianChannel flow = channel(kForce, kPlate);
  CHECK_THROWS_WITH(flow.velocity(-1e-9, 1.0), contains("between the plates"));
  CHECK_THROWS_WITH(flow.gradient(1.1 * kHeight, 1.0), contains("between the plates"));
  CHECK_THROWS_WITH(flow.velocity(0.0, -1.0), contains("negative"));
  CHECK_THROWS_AS(flow.velocity(0.0, nan), std::invalid_argument);
  CHECK_THROWS_AS(poiseuille_fourier(0.0, 0.0, kHeight, kNu, kForce), std::invalid_argument);
}
