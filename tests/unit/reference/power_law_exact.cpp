#include "reference/channel/power_law_exact.hpp"

#include <cmath>
#include <vector>

#include "tests/catch.hpp"

using namespace reference;

namespace {

constexpr double kNu = 1e-6, kPlate = 1e-4, kForce = 8e-3;

template <class F>
double slope(F f, double x, double s) {
  return (45 * (f(x + s) - f(x - s)) - 9 * (f(x + 2 * s) - f(x - 2 * s)) + (f(x + 3 * s) - f(x - 3 * s))) /
         (60 * s);
}

}  // namespace

TEST_CASE("Barenblatt: v_t = (tau)_s, v_s is the rate, the plate's velocity holds") {
  for (double n : {0.3, 0.6, 0.8, 0.999, 1.0, 1.001, 1.2, 1.4, 2.0}) {
    INFO("n = " << n);
    const BarenblattCouette flow(kNu, n, -kPlate);
    for (double t : {1e-4, 0.02}) {
      const double thickness = flow.thickness(t);
      CHECK(flow.rate(0.0, t) * thickness == Approx(-kPlate).epsilon(1e-13));
      CHECK(flow.time_of_thickness(thickness) == Approx(t).epsilon(1e-12));
      CHECK(flow.velocity(0.0, t) == -kPlate);
      for (double share : {0.1, 0.5, 1.0}) {  // all inside the front, where the profile is smooth
        const double s = share * thickness;
        const double v_s = slope([&](double x) { return flow.velocity(x, t); }, s, 0.01 * thickness);
        const double tau_s = slope([&](double x) { return -kNu * std::pow(std::abs(flow.rate(x, t)), n); }, s,
                                   0.01 * thickness);
        const double v_t = slope([&](double r) { return flow.velocity(s, r); }, t, 0.003 * t);
        // Steps of 1 %: truncation 1e-12 times sixth derivatives of some hundreds, round-off 1e-15/0.003.
        CHECK(std::abs(v_s + flow.rate(s, t)) < 1e-9 * kPlate / thickness);
        CHECK(std::abs(v_t + tau_s) < 1e-9 * kPlate / t);
      }
    }
    CHECK(flow.velocity(1e-4, 0.0) == 0.0);
  }
}

TEST_CASE("Barenblatt: the front of n > 1, the tail of n < 1, the error function between") {
  const BarenblattCouette thick(kNu, 1.4, kPlate), thin(kNu, 0.6, kPlate);
  const double arrival = thick.arrival(1e-3);
  CHECK(thick.velocity(1e-3, 0.999 * arrival) == 0.0);
  CHECK(thick.velocity(1e-3, 1.01 * arrival) > 0.0);
  CHECK(std::isinf(thin.arrival(1e-3)));
  // Tail v ~ s^(1 - 2/(1-n)): for n = 0.6 the fourth power; the next term is (thickness/s)^2 of it.
  CHECK(thin.velocity(1e-1, 0.01) / thin.velocity(2e-1, 0.01) == Approx(16.0).epsilon(1e-3));
  const BarenblattCouette newtonian(kNu, 1.0, kPlate), nearly(kNu, 1.0 + 1e-6, kPlate);
  for (double s : {1e-5, 1e-4, 3e-4}) {
    CHECK(newtonian.velocity(s, 0.02) ==
          Approx(kPlate * std::erfc(s / (2 * std::sqrt(kNu * 0.02)))).epsilon(1e-14));
    CHECK(nearly.velocity(s, 0.02) == Approx(newtonian.velocity(s, 0.02)).epsilon(1e-4));
  }
}

TEST_CASE("power-law start-up: u_t = F + (tau)_s, walls, core and front") {
  for (double n : {1.05, 1.2, 1.4, 2.0, 3.0}) {
    INFO("n = " << n);
    const PowerLawStartUp flow(kNu, n, -kForce);
    const double t = 0.02;
    const double front = [&] {  // where the core's velocity is reached: arrival(front) = t
      double low = 1e-6, high = 1.0;
      for (int i = 0; i < 100; ++i) (flow.arrival(0.5 * (low + high)) < t ? low : high) = 0.5 * (low + high);
      return low;
    }();
    CHECK(flow.velocity(0.0, t) == 0.0);
    CHECK(flow.velocity(1.001 * front, t) == -kForce * t);
    CHECK(flow.gradient(1.001 * front, t) == 0.0);
    CHECK(std::abs(flow.velocity(1e-12 * front, t)) <
          1e-10 * kForce * t);  // the profile itself meets the wall
    for (double share : {0.02, 0.1, 0.3}) {
      const double s = share * front, step = 0.005 * front;
      const double u_s = slope([&](double x) { return flow.velocity(x, t); }, s, step);
      const double tau_s =
          slope([&](double x) { return -kNu * std::pow(std::abs(flow.gradient(x, t)), n); }, s, step);
      const double u_t = slope([&](double r) { return flow.velocity(s, r); }, t, 0.003 * t);
      // The layer is a tenth of the distance to the front for n = 1.05, so the steps are some % of its
      // thickness.
      CHECK(std::abs(u_s - flow.gradient(s, t)) < 1e-7 * std::abs(flow.gradient(0.0, t)));
      CHECK(std::abs(u_t + kForce - tau_s) < 1e-7 * kForce);
    }
  }
}

TEST_CASE("exact power-law solutions: bad arguments are refused") {
  CHECK_THROWS_AS(BarenblattCouette(kNu, 0.0, kPlate), std::invalid_argument);
  CHECK_THROWS_WITH(BarenblattCouette(kNu, 1.4, 0.0), contains("move"));
  CHECK_THROWS_WITH(PowerLawStartUp(kNu, 1.0, kForce), contains("1.05"));
  CHECK_THROWS_WITH(PowerLawStartUp(kNu, 1.4, 0.0), contains("zero"));
}
