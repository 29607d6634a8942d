#include "verification/convergence/order.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/catch.hpp"

using namespace verification;

namespace {

using Ladder = std::vector<double>;
const double kNaN = std::numeric_limits<double>::quiet_NaN();
const double kInf = std::numeric_limits<double>::infinity();

Ladder power_law(const Ladder& steps, double coefficient, double order) {
  Ladder errors;
  for (double h : steps) errors.push_back(coefficient * std::pow(h, order));
  return errors;
}

Ladder differences(const Ladder& values) {
  Ladder d;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) d.push_back(std::abs(values[i] - values[i + 1]));
  return d;
}

}  // namespace

TEST_CASE("functional ladders are classified by the ratio of their differences", "[convergence]") {
  CHECK(classify_functional({1.0, 0.5, 0.25}) == Convergence::Monotone);
  CHECK(classify_functional({1.0, 0.0, 0.5}) == Convergence::Oscillatory);
  CHECK(classify_functional({1.0, 0.5, -0.5}) == Convergence::Divergent);
  CHECK(classify_functional({0.0, 1.0, -1.0}) == Convergence::Divergent);
  CHECK(classify_functional({1.0, 0.0, 1.0}) == Convergence::Divergent);   // R = -1
  CHECK(classify_functional({1.0, 0.0, -1.0}) == Convergence::Divergent);  // R = 1
  CHECK(classify_functional({1.0, 1.0, 2.0}) == Convergence::Divergent);   // e32 = 0
  CHECK(classify_functional({1.0, 1.0, 1.0}) == Convergence::Floor);
  CHECK(classify_functional({1.0, 0.5, 0.4}, 0.2) == Convergence::Floor);
  CHECK(classify_functional({1.0, kNaN, 0.25}) == Convergence::Invalid);
  CHECK(classify_functional({1.0, 0.5, kInf}) == Convergence::Invalid);
  // The worst triplet counts.
  CHECK(classify_functional({1.0, 0.5, 0.25, 0.125}) == Convergence::Monotone);
  CHECK(classify_functional({1.0, 0.5, 0.25, 0.3}) == Convergence::Oscillatory);
  CHECK(classify_functional({1.0, 0.5, 0.25, -0.5}) == Convergence::Divergent);
  CHECK_THROWS_WITH(classify_functional({1.0, 0.5}), contains("three"));
  CHECK_THROWS_WITH(classify_functional({1.0, 0.5, 0.2}, -1.0), contains("floor"));
}

TEST_CASE("with the steps known, monotone means a positive order at any ratio", "[convergence]") {
  // First order with r32 = 1.1, r21 = 2: e21 = 0.5 > e32 = 0.1, so R = 5, and yet it converges.
  const Ladder steps{1.1, 1.0, 0.5};
  CHECK(classify_functional(steps, {1.1, 1.0, 0.5}) == Convergence::Monotone);
  CHECK(classify_functional({1.1, 1.0, 0.5}) == Convergence::Divergent);
  // Orders just beside zero, on either side.
  CHECK(classify_functional(steps, power_law(steps, 1.0, 0.01)) == Convergence::Monotone);
  CHECK(classify_functional(steps, power_law(steps, 1.0, -0.01)) == Convergence::Divergent);
  CHECK_THROWS_WITH(classify_functional(steps, {1.0, 0.5}), contains("one value"));
}

TEST_CASE("error ladders are monotone only if they decrease", "[convergence]") {
  CHECK(classify_errors({4.0, 2.0, 1.0}) == Convergence::Monotone);
  CHECK(classify_errors({4.0, 2.0, 2.0}) == Convergence::Divergent);
  CHECK(classify_errors({1.0, 2.0}) == Convergence::Divergent);
  CHECK(classify_errors({4.0, kNaN, 1.0}) == Convergence::Invalid);
  CHECK(classify_errors({kInf, 1.0}) == Convergence::Invalid);
  CHECK(classify_errors({1.0, 0.0}) == Convergence::Floor);
  CHECK_THROWS_WITH(classify_errors({1.0, -1.0}), contains("negative"));
}

TEST_CASE("exact power laws give their order, at any refinement ratio", "[convergence]") {
  const double order = GENERATE(0.5, 1.0, 2.0, 3.7, 4.0);
  for (const Ladder& steps : {Ladder{0.1, 0.05, 0.025, 0.0125}, Ladder{1e-3, 7e-4, 6.5e-4, 1e-4}}) {
    const OrderEstimate e = estimate_order(steps, power_law(steps, 3.0, order));
    CHECK(e.convergence == Convergence::Monotone);
    CHECK(e.order == Approx(order).epsilon(1e-10));  // round-off of logarithms is 1e-15
    CHECK(e.log_coefficient == Approx(std::log(3.0)).epsilon(1e-10));
    CHECK(e.used_count == 4);
    CHECK(e.has_interval);
    CHECK(e.lower <= e.order);
    CHECK(e.upper - e.lower < 1e-10);
    REQUIRE(e.pairwise.size() == 3);
    for (double p : e.pairwise) CHECK(p == Approx(order).epsilon(1e-10));
  }
}

TEST_CASE("the confidence interval is that of Student's t", "[convergence]") {
  // ln e = 2 ln h + delta (1, -2, 1): the pattern is orthogonal to 1 and to ln h, so the slope stays 2, the
  // residual sum of squares is 6 delta^2 with one degree of freedom, Sxx = 2 ln^2 2, and the half width is
  // t sqrt(6 delta^2)/sqrt(2 ln^2 2) = t sqrt(3) delta/ln 2 with t = 12.7062047 (95 %), 6.3137515 (90 %).
  const double delta = 0.01;
  const Ladder steps{4.0, 2.0, 1.0};
  const Ladder errors{16.0 * std::exp(delta), 4.0 * std::exp(-2.0 * delta), std::exp(delta)};
  const double unit = std::sqrt(3.0) * delta / std::log(2.0);
  const OrderEstimate e = estimate_order(steps, errors);
  CHECK(e.order == Approx(2.0).epsilon(1e-12));
  CHECK(e.upper - e.order == Approx(12.7062047 * unit).epsilon(1e-8));  // digits of the tabulated t
  CHECK(e.order - e.lower == Approx(12.7062047 * unit).epsilon(1e-8));
  OrderOptions ninety;
  ninety.confidence = 0.90;
  CHECK(estimate_order(steps, errors, ninety).upper - 2.0 == Approx(6.3137515 * unit).epsilon(1e-8));
}

TEST_CASE("noise widens the interval", "[convergence]") {
  const Ladder steps{8.0, 4.0, 2.0, 1.0};
  double previous = 0.0;
  for (double noise : {0.001, 0.01, 0.1}) {
    Ladder errors = power_law(steps, 1.0, 2.0);
    errors[1] *= 1.0 + noise;
    errors[2] *= 1.0 - noise;
    const OrderEstimate e = estimate_order(steps, errors);
    CHECK(e.upper - e.lower > 5.0 * previous);  // the width is proportional to the noise, here tenfold
    CHECK(e.lower < 2.0);
    CHECK(e.upper > 2.0);
    previous = e.upper - e.lower;
  }
}

TEST_CASE("the 95 % interval covers the order in 95 % of noisy ladders", "[convergence]") {
  const Ladder steps{1.0, 0.5, 0.3, 0.125, 0.0625};
  const int trials = 4000;
  std::mt19937 generator(20190101);
  std::normal_distribution<double> normal;
  int covered = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Ladder errors = power_law(steps, 2.0, 2.0);
    for (double& e : errors) e *= std::exp(0.05 * normal(generator));
    const OrderEstimate e = estimate_order(steps, errors);
    if (e.lower <= 2.0 && 2.0 <= e.upper) ++covered;
  }
  // Binomial: the standard deviation of the share is sqrt(0.95 * 0.05 / 4000) = 0.0034; four of them.
  CHECK(static_cast<double>(covered) / trials == Approx(0.95).margin(0.0138).epsilon(0.0));
}

TEST_CASE("levels at the floor are dropped", "[convergence]") {
  const Ladder steps{8.0, 4.0, 2.0, 1.0};
  const double floor = 1e-3;
  OrderOptions options;
  options.floor = floor;

  SECTION("the order is that of the clear levels") {
    // The last error, 8e-3 of its own plus the floor, lies within 10 floors.
    const OrderEstimate e = estimate_order(steps, {0.512, 0.128, 0.032, 0.009}, options);
    CHECK(e.used == std::vector<bool>{true, true, true, false});
    CHECK(e.used_count == 3);
    CHECK(e.order == Approx(2.0).epsilon(1e-10));
    CHECK(e.convergence == Convergence::Monotone);
    CHECK(e.pairwise[2] == Approx(std::log2(0.032 / 0.009)).epsilon(1e-12));  // shown, but not used
  }
  SECTION("too few clear levels") {
    const OrderEstimate e = estimate_order(steps, {0.02, 0.005, 0.001, 0.001}, options);
    CHECK(e.convergence == Convergence::Floor);
    CHECK(e.used_count == 1);
    CHECK(std::isnan(e.order));
    CHECK(std::isnan(e.lower));
    CHECK_FALSE(e.has_interval);
  }
  SECTION("an exact zero has no logarithm and is always dropped") {
    const OrderEstimate e = estimate_order(steps, {0.64, 0.16, 0.04, 0.0});
    CHECK(e.used_count == 3);
    CHECK(e.order == Approx(2.0).epsilon(1e-10));
    CHECK(std::isnan(e.pairwise[2]));
    CHECK(estimate_order(steps, {0.0, 0.0, 0.0, 0.0}).convergence == Convergence::Floor);
  }
}

TEST_CASE("a NaN or an infinity anywhere makes an order ladder invalid", "[convergence]") {
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  for (std::size_t place = 0; place < 4; ++place) {
    Ladder errors{8.0, 4.0, 2.0, 1.0};
    errors[place] = bad;
    const OrderEstimate e = estimate_order({8.0, 4.0, 2.0, 1.0}, errors);
    CHECK(e.convergence == Convergence::Invalid);
    CHECK(std::isnan(e.order));
    CHECK(std::isnan(e.lower));
    CHECK(std::isnan(e.upper));
    CHECK(e.used_count == 0);
  }
  CHECK(estimate_order_from_differences({4.0, 2.0, 1.0}, {2.0, bad}).convergence == Convergence::Invalid);
}

TEST_CASE("errors that do not decrease are divergent, with their slope", "[convergence]") {
  const OrderEstimate constant = estimate_order({4.0, 2.0, 1.0}, {0.5, 0.5, 0.5});
  CHECK(constant.convergence == Convergence::Divergent);
  CHECK(constant.order == Approx(0.0).margin(1e-14));
  const OrderEstimate growing = estimate_order({4.0, 2.0, 1.0}, {1.0, 2.0, 4.0});
  CHECK(growing.convergence == Convergence::Divergent);
  CHECK(growing.order == Approx(-1.0).epsilon(1e-12));
  // A good slope does not excuse one step back.
  CHECK(estimate_order({8.0, 4.0, 2.0, 1.0}, {64.0, 4.0, 4.5, 1.0}).convergence == Convergence::Divergent);
}

TEST_CASE("two levels give an order without an interval", "[convergence]") {
  const OrderEstimate e = estimate_order({2.0, 1.0}, {4.0, 1.0});
  CHECK(e.convergence == Convergence::Monotone);
  CHECK(e.order == Approx(2.0).epsilon(1e-12));
  CHECK_FALSE(e.has_interval);
  CHECK(std::isnan(e.lower));
  CHECK(std::isnan(e.upper));
}

TEST_CASE("successive differences give the order without an exact solution", "[convergence]") {
  const double order = GENERATE(0.5, 1.0, 2.0, 4.0);

  SECTION("constant ratio: the slope over the coarser steps") {
    const Ladder dts{0.8, 0.4, 0.2, 0.1, 0.05};
    const Ladder d = differences(power_law(dts, -5.0, order));
    Ladder coarser = successive_steps(dts);
    CHECK(coarser == Ladder{0.8, 0.4, 0.2, 0.1});
    const OrderEstimate slope = estimate_order(coarser, d);
    const OrderEstimate exact = estimate_order_from_differences(dts, d);
    CHECK(slope.order == Approx(order).epsilon(1e-10));
    CHECK(exact.order == Approx(order).epsilon(1e-10));
    CHECK(exact.log_coefficient == Approx(std::log(5.0)).epsilon(1e-9));
    CHECK(exact.convergence == Convergence::Monotone);
  }
  SECTION("other ratios: the slope misleads, the fit does not") {
    const Ladder dts{0.8, 0.5, 0.3, 0.1};
    const Ladder d = differences(power_law(dts, 5.0, order));
    const OrderEstimate exact = estimate_order_from_differences(dts, d);
    CHECK(exact.order == Approx(order).epsilon(1e-10));
    CHECK(exact.convergence == Convergence::Monotone);
    CHECK(exact.used_count == 3);
    REQUIRE(exact.pairwise.size() == 2);
    for (double p : exact.pairwise) CHECK(p == Approx(order).epsilon(1e-10));
    CHECK(std::abs(estimate_order(successive_steps(dts), d).order - order) > 0.05);  // why this exists
  }
}

TEST_CASE("with a constant ratio the difference fit is the linear regression", "[convergence]") {
  const Ladder dts{16.0, 8.0, 4.0, 2.0, 1.0};
  const Ladder d{1.03, 0.49, 0.26, 0.12};
  const OrderEstimate fit = estimate_order_from_differences(dts, d);
  const OrderEstimate line = estimate_order(successive_steps(dts), d);
  CHECK(fit.order == Approx(line.order).epsilon(1e-10));
  CHECK(fit.lower == Approx(line.lower).epsilon(1e-9));
  CHECK(fit.upper == Approx(line.upper).epsilon(1e-9));
}

TEST_CASE("difference ladders are classified and thinned like error ladders", "[convergence]") {
  const Ladder dts{8.0, 5.0, 3.0, 1.0};
  CHECK(estimate_order_from_differences(dts, differences(power_law(dts, 1.0, -1.0))).convergence ==
        Convergence::Divergent);
  CHECK(estimate_order_from_differences(dts, differences(power_law(dts, 1.0, -1.0))).order ==
        Approx(-1.0).epsilon(1e-10));
  OrderOptions options;
  options.floor = 0.15;
  // Differences of a first-order ladder are 3, 2, 2: none within 10 x 0.15; then all but one within 10 x
  // 0.25.
  CHECK(estimate_order_from_differences(dts, {3.0, 2.0, 2.0}, options).order == Approx(1.0).epsilon(1e-10));
  options.floor = 0.25;
  CHECK(estimate_order_from_differences(dts, {3.0, 2.0, 2.0}, options).convergence == Convergence::Floor);
  const OrderEstimate two = estimate_order_from_differences({4.0, 2.0, 1.0}, {2.0, 1.0});
  CHECK(two.order == Approx(1.0).epsilon(1e-10));
  CHECK_FALSE(two.has_interval);
  CHECK(std::isnan(estimate_order_from_differences({4.0, 2.0, 1.0}, {2.0, 0.0}).pairwise[0]));
}

TEST_CASE("the linearised interval of differences covers the order too", "[convergence]") {
  const Ladder dts{1.0, 0.6, 0.3, 0.2, 0.08, 0.04};
  const Ladder clean = differences(power_law(dts, 1.0, 1.0));
  const int trials = 2000;
  std::mt19937 generator(20190102);
  std::normal_distribution<double> normal;
  int covered = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Ladder d = clean;
    for (double& value : d) value *= std::exp(0.02 * normal(generator));
    const OrderEstimate e = estimate_order_from_differences(dts, d);
    if (e.lower <= 1.0 && 1.0 <= e.upper) ++covered;
  }
  // Four standard deviations sqrt(0.95 * 0.05 / 2000) = 0.0049; 2 % noise keeps the curvature of the model
  // small.
  CHECK(static_cast<double>(covered) / trials == Approx(0.95).margin(0.0196).epsilon(0.0));
}

TEST_CASE("the three-grid order solves its equation for either sign", "[convergence]") {
  for (double p : {-2.0, -0.3, 1e-6, 0.7, 2.0, 6.0}) {
    const double r21 = 1.5;
    const double r32 = 1.2;
    const double monotone = (std::pow(r21 * r32, p) - std::pow(r21, p)) / (std::pow(r21, p) - 1.0);
    CHECK(three_grid_order(r21, r32, monotone, 1) == Approx(p).epsilon(1e-9).margin(1e-9));
    const double oscillatory = std::pow(r21, p) * (std::pow(r32, p) + 1.0) / (std::pow(r21, p) + 1.0);
    CHECK(three_grid_order(r21, r32, oscillatory, -1) == Approx(p).epsilon(1e-9).margin(1e-9));
  }
  CHECK_THROWS_AS(three_grid_order(1.0, 2.0, 2.0, 1), std::invalid_argument);
  CHECK_THROWS_AS(three_grid_order(2.0, 2.0, 0.0, 1), std::invalid_argument);
  CHECK_THROWS_AS(three_grid_order(2.0, 2.0, 2.0, 0), std::invalid_argument);
}

TEST_CASE("order fits refuse bad arguments", "[convergence]") {
  const Ladder errors{2.0, 1.0};
  CHECK_THROWS_WITH(estimate_order({1.0}, {1.0}), contains("at least 2"));
  CHECK_THROWS_WITH(estimate_order({1.0, 2.0}, errors), contains("decrease"));
  CHECK_THROWS_WITH(estimate_order({1.0, 1.0}, errors), contains("decrease"));
  CHECK_THROWS_WITH(estimate_order({1.0, -1.0}, errors), contains("positive"));
  CHECK_THROWS_WITH(estimate_order({kNaN, 1.0}, errors), contains("positive"));
  CHECK_THROWS_WITH(estimate_order({2.0, 1.0}, {1.0}), contains("one error"));
  CHECK_THROWS_WITH(estimate_order({2.0, 1.0}, {1.0, -1.0}), contains("negative"));
  OrderOptions options;
  options.floor = -1.0;
  CHECK_THROWS_WITH(estimate_order({2.0, 1.0}, errors, options), contains("floor"));
  options = {};
  options.floor_factor = 0.5;
  CHECK_THROWS_WITH(estimate_order({2.0, 1.0}, errors, options), contains("factor"));
  options = {};
  options.confidence = 1.0;
  CHECK_THROWS_WITH(estimate_order({2.0, 1.0}, errors, options), contains("confidence"));
  CHECK_THROWS_WITH(estimate_order_from_differences({2.0, 1.0}, {1.0}), contains("at least 3"));
  CHECK_THROWS_WITH(estimate_order_from_differences({3.0, 2.0, 1.0}, {1.0}), contains("one difference"));
  CHECK_THROWS_AS(successive_steps({1.0, 2.0}), std::invalid_argument);
}
