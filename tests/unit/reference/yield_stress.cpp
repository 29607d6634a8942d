#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/channel/cessation_bound.hpp"
#include "reference/channel/channel_factory.hpp"
#include "reference/channel/ideal_yield_channel.hpp"
#include "reference/channel/steady_channel.hpp"
#include "reference/transient/finite_volume_channel.hpp"
#include "tests/catch.hpp"

using namespace reference;

namespace {

constexpr double kHeight = 1e-3, kForce = 8e-3, kPlate = 1e-4, kNu = 1e-6;

HerschelBulkleyCurve fluid(double n, double share, double m) {
  return {kNu, n, share * kForce * kHeight, m};
}

/// Largest difference from the second discretisation [m/s].
double disagreement(const FiniteVolumeProfile& fv, const ChannelSolution& flow, double t) {
  double most = 0.0;
  for (std::size_t j = 0; j < fv.velocity.size(); ++j)
    most = std::max(most, std::abs(fv.velocity[j] - flow.velocity(std::min(fv.node_heights[j], kHeight), t)));
  return most;
}

/// Root mean square over the gap of a solution at one time [m/s], midpoint rule.
double speed(const ChannelSolution& flow, double t) {
  constexpr int kPoints = 400;
  double sum = 0.0;
  for (int j = 0; j < kPoints; ++j) sum += std::pow(flow.velocity((j + 0.5) / kPoints * kHeight, t), 2);
  return std::sqrt(sum / kPoints);
}

}  // namespace

TEST_CASE("Herschel-Bulkley curve: rate inverts stress, slope is its derivative, potential its integral") {
  for (const double n : {0.6, 1.0, 1.4})
    for (const double m : {1.0, 100.0, 1e6}) {
      const FlowCurve curve = fluid(n, 0.25, m);
      INFO(curve.describe());
      double integral = 0.0, last = 0.0;
      for (double w = 1e-9; w < 1e5; w *= 1.07) {
        // The last bits of the stress come back multiplied by 1/local exponent.
        CHECK(curve.rate(curve.stress(w)) == Approx(w).epsilon(1e-14 + 4e-16 / curve.local_exponent(w)));
        CHECK(curve.rate(-curve.stress(w)) == -curve.rate(curve.stress(w)));
        // Central difference over 1e-4 w: (1e-4)^2/6 of (m w)^2 < 200 while exp(-m w) matters, and the
        // round-off of the stress.
        const double slope = (curve.stress(w * 1.0001) - curve.stress(w * 0.9999)) / (2e-4 * w);
        CHECK(slope == Approx(curve.slope(w)).epsilon(4e-7 + 4e-12 / curve.local_exponent(w)));
        // Boole's rule over 7 %.
        const auto at = [&](double f) { return curve.stress(last + f * (w - last)); };
        integral =
            last == 0.0
                ? curve.potential(w)
                : integral + (w - last) / 90 *
                                 (7 * at(0) + 32 * at(0.25) + 12 * at(0.5) + 32 * at(0.75) + 7 * at(1));
        CHECK(curve.potential(w) == Approx(integral).epsilon(1e-6));
        last = w;
      }
    }
  const FlowCurve ideal = fluid(1.0, 0.25, 1.0).ideal();
  CHECK(ideal.rate(1.9e-6) == 0.0);
  CHECK(ideal.rate(2.5e-6) == Approx(0.5).epsilon(1e-14));
  CHECK(ideal.stress(0.0) == 0.0);
  CHECK(ideal.stress(1e-9) == Approx(2e-6 + 1e-15).epsilon(1e-15));
}

TEST_CASE("Herschel-Bulkley curve: parameters out of range are named") {
  CHECK_THROWS_WITH(FlowCurve(HerschelBulkleyCurve{1e-6, 1.0, 0.0, 1.0}), contains("tau_y"));
  CHECK_THROWS_WITH(FlowCurve(HerschelBulkleyCurve{1e-6, 1.0, 1e-6, 0.0}), contains("m must"));
  CHECK_THROWS_WITH(FlowCurve(HerschelBulkleyCurve{1e-6, NAN, 1e-6, 1.0}), contains("n must"));
}

TEST_CASE("ideal Bingham Poiseuille flow: Buckingham's plug and parabola") {
  const IdealYieldChannel flow(kHeight, kForce, 0.0, fluid(1.0, 0.25, 1.0));
  CHECK(flow.plug_begin() == Approx(0.25e-3).epsilon(1e-14));
  CHECK(flow.plug_end() == Approx(0.75e-3).epsilon(1e-14));
  // (F/2 nu)(H/2 - z_0)^2 = 4e3 (2.5e-4)^2
  CHECK(flow.steady_maximum() == Approx(2.5e-4).epsilon(1e-14));
  CHECK(flow.velocity(0.4e-3) == flow.velocity(0.6e-3));
  CHECK(flow.velocity(0.3e-3) == Approx(flow.steady_maximum()).epsilon(1e-15));
  CHECK(flow.gradient(0.0) == Approx(2.0).epsilon(1e-14));
  CHECK(flow.gradient(0.5e-3) == 0.0);
  const IdealYieldChannel stuck(kHeight, kForce, 0.0, fluid(1.0, 0.51, 1.0));
  CHECK(stuck.at_rest());
  CHECK(stuck.steady_maximum() == 0.0);
  CHECK_FALSE(flow.at_rest());
}

TEST_CASE("ideal Couette flow: sheared as a whole, whatever the yield stress") {
  const IdealYieldChannel flow(kHeight, 0.0, kPlate, fluid(0.6, 0.25, 1.0));
  CHECK(flow.velocity(0.3e-3) == Approx(0.3e-4).epsilon(1e-14));
  CHECK(flow.stress(0.1e-3) == Approx(2e-6 + kNu * std::pow(0.1, 0.6)).epsilon(1e-14));
}

TEST_CASE("steady flow of the regularised fluid tends to the closed form of the ideal one") {
  const double n = GENERATE(0.6, 1.0, 1.4), share = GENERATE(0.125, 0.25);
  const double plate = GENERATE(0.0, kPlate, -kPlate);
  INFO("n = " << n << ", tau_y = " << share << " F H, V0 = " << plate);
  const IdealYieldChannel closed(kHeight, kForce, plate, fluid(n, share, 1.0));
  const SteadyChannel limit(kHeight, kForce, plate, fluid(n, share, 1.0).ideal());
  const SteadyChannel coarse(kHeight, kForce, plate, fluid(n, share, 4000.0)),
      fine(kHeight, kForce, plate, fluid(n, share, 8000.0));
  double of_limit = 0.0, of_extrapolation = 0.0, of_fine = 0.0;
  // Places outside the layers about the plug's edges in which the rates are of order 1/m.
  for (double y = 0.0; y <= kHeight; y += kHeight / 64) {
    const double exact = closed.velocity(y);
    of_limit = std::max(of_limit, std::abs(limit.velocity(y) - exact));
    of_fine = std::max(of_fine, std::abs(fine.velocity(y) - exact));
    if (std::abs(closed.gradient(y)) > 0.01)
      of_extrapolation =
          std::max(of_extrapolation, std::abs(2 * fine.velocity(y) - coarse.velocity(y) - exact));
  }
  const double scale = closed.steady_maximum();
  CHECK(of_limit < 1e-12 * scale);
  if (plate == 0.0) CHECK(of_extrapolation < 1e-10 * scale);
  // The envelope of the potentials: the plug moves by tau_y/(m F) and all else by less than twice that.
  CHECK(of_fine < 2 * fluid(n, share, 1.0).tau_y / (8000.0 * kForce));
  if (plate == 0.0)
    CHECK((fine.maximum() - scale) * 8000.0 * kForce / fluid(n, share, 1.0).tau_y == Approx(1).epsilon(1e-8));
}

TEST_CASE("below the yield stress the regularised fluid creeps, as 1/m") {
  const auto creep = [](double m) {
    return SteadyChannel(kHeight, kForce, 0.0, fluid(1.0, 0.6, m)).maximum();
  };
  CHECK(creep(1e4) / creep(2e4) == Approx(2).epsilon(1e-3));
  // tau = tau_y (1 - exp(-m w)) without the viscosity: below the plug's 2 ln(...) H/(2 m).
  CHECK(creep(1e6) < kHeight / 1e6);
}

TEST_CASE("transient of a regularised yield stress: two discretisations agree, start-up and cessation") {
  const double n = GENERATE(0.6, 1.0, 1.4);
  const bool cessation = GENERATE(false, true);
  INFO("n = " << n << (cessation ? ", cessation" : ", start-up"));
  ChannelProblem problem{kHeight, cessation ? 0.0 : kForce, 0.0, fluid(n, 0.25, 50.0), {0.01, 0.02}};
  if (cessation) problem.initial_acceleration = kForce;
  const auto flow = make_channel_solution(problem);
  CHECK(flow->stated_error() < 2e-5);
  const double t = cessation ? 0.01 : 0.02;
  const FiniteVolumeProfile fv = finite_volume_channel(problem, t, 16, 16);
  CHECK(disagreement(fv, *flow, t) < fv.velocity_error + flow->stated_error() * flow->steady_maximum());
  CHECK(fv.velocity_error < 2e-3 * flow->steady_maximum());  // 144 cells about a bend
}

TEST_CASE("transient of a sharp yield stress: two discretisations agree once the second resolves its layer") {
  ChannelProblem problem{kHeight, 0.0, 0.0, fluid(1.0, 0.25, 1000.0), {0.01, 0.02}};
  problem.initial_acceleration = kForce;
  const auto flow = make_channel_solution(problem);
  // On 16 cells the finite volumes miss the layer and with it their own error, by a factor of ten.
  const FiniteVolumeProfile fv = finite_volume_channel(problem, 0.01, 32, 32);
  CHECK(disagreement(fv, *flow, 0.01) < fv.velocity_error + flow->stated_error() * flow->steady_maximum());
  CHECK(fv.velocity_error < 1e-3 * speed(*flow, 0.0));
}

TEST_CASE("a steady flow that loses its force: Newtonian series against the second discretisation") {
  ChannelProblem problem{kHeight, 0.25 * kForce, 0.0, NewtonianCurve{kNu}, {0.02, 0.2}};
  problem.initial_acceleration = kForce;
  const auto flow = make_channel_solution(problem);
  CHECK(flow->velocity(0.5 * kHeight, 0.0) == Approx(1e-3).epsilon(1e-13));
  for (const double t : problem.times) {
    const FiniteVolumeProfile fv = finite_volume_channel(problem, t, 16, 16);
    CHECK(disagreement(fv, *flow, t) < fv.velocity_error);
  }
  problem.plate_velocity = kPlate;
  CHECK_THROWS_WITH(make_channel_solution(problem), contains("plates at rest"));
}

TEST_CASE("cessation: no reference crosses the bound, which falls as its differential equation says") {
  const HerschelBulkleyCurve curve = fluid(1.0, 0.25, 200.0);
  const CessationBound bound(kHeight, curve);
  ChannelProblem problem{kHeight, 0.0, 0.0, curve, {}};
  problem.initial_acceleration = kForce;
  for (int k = 1; k <= 20; ++k) problem.times.push_back(0.003 * k);
  const auto flow = make_channel_solution(problem);
  const double u_0 = speed(*flow, 0.0);
  for (const double t : problem.times) CHECK(speed(*flow, t) <= bound.speed(u_0, t));
  CHECK(speed(*flow, 0.5 * bound.stopping_time(u_0)) > 0.01 * u_0);  // not an empty statement
  // Bingham's ideal fluid: ln(1 + a u/b)/a.
  CHECK(bound.stopping_time(2e-4) == Approx(std::log1p(9.8696044 * 2e-4 / 4e-3) / 9.8696044).epsilon(1e-7));
  CHECK(bound.speed(u_0, 0.0) == Approx(u_0).epsilon(1e-12));
  const double t = 0.01, e = 1e-6, u = bound.speed(u_0, t);
  const double slope = (bound.speed(u_0, t + e) - bound.speed(u_0, t - e)) / (2 * e);
  CHECK(slope == Approx(-9.8696044 * u - 4e-3 + 2e-6 / (2.718281828 * 200.0 * u)).epsilon(1e-6));
  // Long after: a creep of H/(2 e m), less what viscosity takes, a u/b = 0.23 % of it.
  const double creep = kHeight / (2 * 2.718281828 * 200.0);
  CHECK(bound.speed(u_0, 10.0) == Approx(creep / (1 + 9.8696044 * creep / 4e-3)).epsilon(1e-5));
  const CessationBound thinning(kHeight, fluid(0.6, 0.25, 1e9));
  CHECK(thinning.stopping_time(2e-4) == Approx(0.05).epsilon(1e-12));
  CHECK(thinning.speed(2e-4, 0.025) == Approx(1e-4).epsilon(1e-4));
}
