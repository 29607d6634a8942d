#include "reference/fluids/flow_curve.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "tests/catch.hpp"

using namespace reference;

namespace {

std::vector<FlowCurve> curves() {
  return {NewtonianCurve{2e-6},
          CrossCurve{1e-6, 0.25e-6, 1.0, 1.0},
          CrossCurve{1e-6, 50e-6, 1.0, 1.0},
          CrossCurve{1e-6, 0.1e-6, 2.0, 0.6},
          CrossCurve{1e-6, 0.5e-6, 1.0, 2.0},
          PowerLawCurve{1e-6, 0.3},
          PowerLawCurve{1e-6, 2.0},
          CarreauYasudaCurve{1e-6, 1e-8, 3.0, 2.0, 0.4},
          CarreauYasudaCurve{1e-6, 0.0, 3.0, 1.3, 1.5}};
}

}  // namespace

TEST_CASE("flow curve: rate inverts stress, slope is its derivative, potential its integral") {
  for (const FlowCurve& curve : curves()) {
    INFO(curve.describe());
    double integral = 0.0, last = 0.0;
    for (double w = 1e-6; w < 1e7; w *= 1.37) {
      // The inverse multiplies the stress's last bits by w/(tau dw/dtau) = 1/local exponent, 1/0.3 at most.
      CHECK(curve.rate(curve.stress(w)) == Approx(w).epsilon(4e-15));
      CHECK(curve.rate(-curve.stress(w)) == -curve.rate(curve.stress(w)));
      CHECK(curve.stress(w) == w * curve.viscosity(w));
      // Central difference over 1e-4 w: truncation (1e-4)^2/6 of the third logarithmic derivative, of order
      // one.
      CHECK((curve.stress(w * 1.0001) - curve.stress(w * 0.9999)) / (2e-4 * w) ==
            Approx(curve.slope(w)).epsilon(1e-7));
      // Boole's rule over a factor of 1.37: relative error (0.37/4)^6 times derivatives of order ten, 1e-5.
      if (last == 0.0) {
        integral = curve.potential(w);
      } else {
        const auto at = [&](double f) { return curve.stress(last + f * (w - last)); };
        integral += (w - last) / 90 * (7 * at(0) + 32 * at(0.25) + 12 * at(0.5) + 32 * at(0.75) + 7 * at(1));
        CHECK(curve.potential(w) == Approx(integral).epsilon(1e-5));
      }
      last = w;
    }
    CHECK(curve.stress(0.0) == 0.0);
    CHECK(curve.rate(0.0) == 0.0);
    CHECK(curve.potential(0.0) == 0.0);
  }
}

TEST_CASE("flow curve: closed forms and quadrature agree where a parameter passes through the closed case") {
  // M = 1 + 1e-9 takes the general route; the curves differ by 1e-9 log(K w).
  const FlowCurve closed = CrossCurve{1e-6, 4e-6, 1.0, 1.0},
                  general = CrossCurve{1e-6, 4e-6, 1.0, 1.0 + 1e-9};
  for (double w : {1e-5, 0.02, 0.0999, 0.1001, 1.0, 40.0, 1e6}) {
    CHECK(closed.potential(w) == Approx(general.potential(w)).epsilon(3e-8));
    CHECK(closed.rate(closed.stress(w)) == Approx(general.rate(closed.stress(w))).epsilon(3e-8));
  }
}

TEST_CASE("flow curve: Newtonian limits are recognised") {
  CHECK(FlowCurve(CrossCurve{2e-6, 2e-6, 1.0, 0.7}).newtonian() == std::optional(2e-6));
  CHECK(FlowCurve(PowerLawCurve{3e-6, 1.0}).newtonian() == std::optional(3e-6));
  CHECK(FlowCurve(CarreauYasudaCurve{3e-6, 1e-6, 1.0, 2.0, 1.0}).newtonian() == std::optional(3e-6));
  CHECK(FlowCurve(NewtonianCurve{4e-6}).newtonian() == std::optional(4e-6));
  CHECK_FALSE(FlowCurve(CrossCurve{2e-6, 2.1e-6, 1.0, 1.0}).newtonian());
  CHECK_FALSE(FlowCurve(PowerLawCurve{2e-6, 1.01}).newtonian());
}

TEST_CASE("flow curve: what the power law does at rest") {
  CHECK(std::isinf(FlowCurve(PowerLawCurve{1e-6, 0.6}).viscosity(0.0)));
  CHECK(FlowCurve(PowerLawCurve{1e-6, 1.4}).viscosity(0.0) == 0.0);
}

TEST_CASE("flow curve: falling stress and bad parameters are refused") {
  // Monotone iff nu_inf > (nu_0 - nu_inf)(M-1)^2/(4M): for M = 2, nu_inf > nu_0/9.
  CHECK_NOTHROW(FlowCurve(CrossCurve{1e-6, 1.01e-6 / 9, 1.0, 2.0}).require_monotone(1e4));
  const FlowCurve falling = CrossCurve{1e-6, 0.99e-6 / 9, 1.0, 2.0};
  CHECK_THROWS_WITH(falling.require_monotone(1e4), contains("falls with the shear rate"));
  CHECK_NOTHROW(falling.require_monotone(1.0));  // the dip is at K w = sqrt 3
  // Without nu_inf a Cross fluid of M = 1 carries at most nu_0/K.
  CHECK_THROWS_WITH(FlowCurve(CrossCurve{1e-6, 0.0, 1.0, 1.0}).rate(1.1e-6),
                    contains("no finite shear rate"));
  CHECK(FlowCurve(CrossCurve{1e-6, 0.0, 1.0, 1.0}).rate(0.5e-6) == Approx(1.0).epsilon(1e-14));

  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(FlowCurve(NewtonianCurve{0.0}), contains("nu"));
  CHECK_THROWS_WITH(FlowCurve(CrossCurve{1e-6, -1e-6, 1.0, 1.0}), contains("nu_inf"));
  CHECK_THROWS_WITH(FlowCurve(CrossCurve{1e-6, 1e-6, 0.0, 1.0}), contains("K"));
  CHECK_THROWS_WITH(FlowCurve(CrossCurve{1e-6, 1e-6, 1.0, nan}), contains("M"));
  CHECK_THROWS_WITH(FlowCurve(PowerLawCurve{1e-6, 0.0}), contains("n must"));
  CHECK_THROWS_WITH(FlowCurve(CarreauYasudaCurve{1e-6, 0.0, 1.0, 0.0, 0.5}), contains("a must"));
}
