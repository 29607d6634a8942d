#include "verification/convergence/step_by_error.hpp"

#include <cmath>
#include <limits>

#include "tests/catch.hpp"

using namespace verification;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double none = 1e-11;

auto about(double value, double relative = 1e-12) {
  return Catch::Matchers::WithinRel(value, relative);
}

/// Norms of u(dt) - u(dt/2) and u(dt/2) - u(dt/4) where u(dt) = u + C dt^q.
TimeError of_power(double c, double q, double dt, double formal) {
  const auto e = [&](double step) { return c * std::pow(step, q); };
  return time_error_of(dt, e(dt) - e(dt / 2), e(dt / 2) - e(dt / 4), formal, none);
}

}  // namespace

TEST_CASE("three steps give coefficient and order of the error in time", "[step-by-error]") {
  for (const double q : {1.0, 2.0}) {
    const TimeError error = of_power(3.5, q, 0.02, q);
    REQUIRE(error.kind == TimeError::Kind::Law);
    CHECK_THAT(error.law.order, about(q));
    CHECK_THAT(error.law.coefficient, about(3.5, 1e-11));
    CHECK_THAT(error.law.inverse(error.law.at(7e-3)), about(7e-3));
  }
}

TEST_CASE("a better order than theory's is not relied on, a reduced one is taken as it is",
          "[step-by-error]") {
  const TimeError lucky = of_power(3.5, 3, 0.02, 2);
  CHECK(lucky.law.order == 2);
  CHECK_THAT(lucky.observed_order, about(3));
  // It is exact for the larger difference, so that shorter steps are thought worse than they are.
  CHECK(lucky.law.at(0.01) > 3.5 * std::pow(0.01, 3));
  const TimeError reduced = of_power(3.5, 1.4, 0.02, 2);
  CHECK_THAT(reduced.law.order, about(1.4));
  CHECK_THAT(reduced.law.at(0.005), about(3.5 * std::pow(0.005, 1.4)));
}

TEST_CASE("noise, errors that do not fall and values that are none have no order", "[step-by-error]") {
  CHECK(time_error_of(0.02, 1e-4, 1.1e-4, 1, none).kind == TimeError::Kind::NoOrder);
  CHECK(time_error_of(0.02, 1e-4, 0.8e-4, 1, none).kind == TimeError::Kind::NoOrder);
  CHECK(time_error_of(0.02, 1e-4, infinity, 1, none).kind == TimeError::Kind::NoOrder);
  CHECK(time_error_of(0.02, std::nan(""), 1e-5, 1, none).kind == TimeError::Kind::NoOrder);
  CHECK(time_error_of(0.02, 3e-13, 5e-13, 2, none).kind == TimeError::Kind::RoundOff);
  // A step longer than what the shorter ones resolve: differences of 1 % of the larger still are an order.
  CHECK(time_error_of(0.02, 1e-4, 1e-6, 2, none).kind == TimeError::Kind::Law);
}

TEST_CASE("two meshes give the law of the error in space, and theory's order is the least",
          "[step-by-error]") {
  const auto e = [](double h) { return 40 * std::pow(h, 3.2); };
  const PowerLaw seen = space_error_of(0.1, e(0.1), 0.05, e(0.05), 3);
  CHECK_THAT(seen.order, about(3.2));
  CHECK_THAT(seen.coefficient, about(40));
  const PowerLaw cautious = space_error_of(0.1, e(0.1), 0.05, e(0.05), 4);
  CHECK(cautious.order == 4);
  CHECK_THAT(cautious.at(0.05), about(e(0.05)));
  CHECK(cautious.at(0.025) < seen.at(0.025));
  CHECK_THAT(space_error_of(0.1, e(0.1), 0.05, e(0.05), std::nan("")).order, about(3.2));
}

TEST_CASE("the step is the one at which the law has the target, in whole parts", "[step-by-error]") {
  const PowerLaw time{2.0, 2.0};
  // (1e-4/2)^(1/2) = 7.07e-3: 0.1 s in 15 parts
  const ChosenStep free = step_by_error(time, 1e-4, infinity, infinity, 0.1);
  CHECK(free.bound == StepBound::Error);
  CHECK_THAT(free.dt, about(0.1 / 15));
  CHECK(time.at(free.dt) <= 1e-4);
  CHECK(time.at(0.1 / 14) > 1e-4);
  // One that divides already is not cut again.
  CHECK_THAT(step_by_error(time, 2 * 1e-4, infinity, infinity, 0.1).dt, about(0.01));
}

TEST_CASE("what is shorter than the step by error bounds it, and is named", "[step-by-error]") {
  const PowerLaw time{2.0, 2.0};
  const ChosenStep stable = step_by_error(time, 1e-4, 3e-3, infinity, 0.1);
  CHECK(stable.bound == StepBound::Stability);
  CHECK_THAT(stable.dt, about(0.1 / 34));
  const ChosenStep tried = step_by_error(time, 1e-4, infinity, 0.005, 0.1);
  CHECK(tried.bound == StepBound::Pilot);
  CHECK_THAT(tried.dt, about(0.005));
  const ChosenStep outputs = step_by_error(time, 1.0, infinity, infinity, 0.1);
  CHECK(outputs.bound == StepBound::Outputs);
  CHECK(outputs.dt == 0.1);
  CHECK(step_by_bounds(infinity, infinity, 0.1).bound == StepBound::Outputs);
  CHECK(step_by_bounds(0.03, infinity, 0.1).bound == StepBound::Stability);
  CHECK(step_by_error(time, 0, infinity, infinity, 0.1).bound == StepBound::None);
  CHECK(step_by_error(time, -1e-6, 0.01, infinity, 0.1).bound == StepBound::None);
  CHECK(step_by_error(time, std::nan(""), 0.01, infinity, 0.1).bound == StepBound::None);
}

TEST_CASE("steps divide the interval that all output intervals are multiples of", "[step-by-error]") {
  CHECK_THAT(common_interval(0, {0.05, 0.1, 0.2, 0.5, 1.0}), about(0.05, 1e-9));
  CHECK_THAT(common_interval(0, {0.1, 0.25}), about(0.05, 1e-9));
  CHECK_THAT(common_interval(0.02, {0.05, 0.1}), about(0.01, 1e-9));
  CHECK(common_interval(0, {0.5}) == 0.5);
  // 1/3 and 1: no common part of a sensible length
  CHECK_THAT(common_interval(0, {0.3333, 1.0}), about(0.3333));
}
