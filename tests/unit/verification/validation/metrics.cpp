#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/catch.hpp"
#include "verification/validation/area_metric.hpp"
#include "verification/validation/bias_scatter.hpp"
#include "verification/validation/comparison_error.hpp"
#include "verification/validation/latin_hypercube.hpp"

using namespace verification;

TEST_CASE("Area metric: the published worked numbers", "[validation]") {
  // ASME V&V 10.1-2012, approach 1: beam deflections [mm], three-sigma widths of 0.71 and 0.75.
  const Area beam = area_between(Normal{-14.2, 0.71 / 3}, Normal{-15.0, 0.75 / 3});
  CHECK(beam.total() == Approx(0.8000).margin(5e-5));
  CHECK(beam.total() / 15 == Approx(0.05333).margin(5e-6));
  CHECK(beam.above > beam.below);  // the model deflects less: its values lie higher

  const Area widths = area_between(Normal{0, 1}, Normal{0, 2});
  CHECK(widths.total() == Approx(std::sqrt(2 / std::numbers::pi)).epsilon(1e-12));
  CHECK(widths.above == Approx(widths.below).epsilon(1e-12));

  const Area steps =
      area_between(std::vector<WeightedValue>{{960, 0.4}, {1020, 0.6}},
                   std::vector<WeightedValue>{{960, 0.2}, {970, 0.2}, {1020, 0.5}, {1030, 0.1}});
  CHECK(steps.total() == Approx(3).epsilon(1e-12));
  CHECK(steps.below == Approx(3).epsilon(1e-12));
}

TEST_CASE("Area metric: limits", "[validation]") {
  CHECK(area_between(Normal{3, 0}, Normal{1, 0}).above == 2);
  CHECK(area_between(Normal{1, 0}, Normal{3, 0}).below == 2);
  CHECK(area_between(Normal{2, 0.5}, Normal{2, 0.5}).total() == 0);
  // A known value against N(0, 1): E|x| = sqrt(2/pi).
  CHECK(area_between(Normal{0, 0}, Normal{0, 1}).total() == Approx(std::sqrt(2 / std::numbers::pi)));
  CHECK(std::isnan(area_between(Normal{std::nan(""), 1}, Normal{0, 1}).total()));
  CHECK_THROWS_AS(area_between(Normal{0, -1}, Normal{0, 1}), std::invalid_argument);
  CHECK_THROWS_AS(area_between(std::vector<WeightedValue>{}, std::vector<WeightedValue>{{1, 1}}),
                  std::invalid_argument);
}

TEST_CASE("Area metric: samples approach the distribution that they are of", "[validation]") {
  const auto samples = latin_hypercube({{InputDistribution::Shape::Normal, 1.0, 0.5}}, 4000, 1);
  std::vector<WeightedValue> values;
  for (const auto& row : samples) values.push_back({row[0], 1});
  const Area empirical = area_between(values, std::vector<WeightedValue>{{1.8, 1}});
  const Area exact = area_between(Normal{1.0, 0.5}, Normal{1.8, 0});
  CHECK(empirical.above == Approx(exact.above).margin(1e-3));  // 1/4000 of a width in 0.5
  CHECK(empirical.below == Approx(exact.below).margin(1e-3));
}

TEST_CASE("Bias and scatter: the fire guides' example and a known ensemble", "[validation]") {
  // NIST FDS Validation Guide: 155 K computed, critical 200 C, ambient 20 C; the guide prints 0.06.
  CHECK(exceedance_probability(155, 200 - 20, {1.13, 0.20, 0}) == Approx(0.0592).margin(5e-5));

  // Computed values too high by 1.2 in the median: r = ln 1.2 +- s.
  const double s = 0.1;
  const BiasScatter model = bias_and_scatter({{1.2 * std::exp(s), 1}, {1.2 * std::exp(-s), 1}}, 0.05);
  const double variance = 2 * s * s;  // n - 1 = 1
  CHECK(model.scatter == Approx(std::sqrt(variance - 0.0025)));
  CHECK(model.bias == Approx(1.2 * std::exp(0.5 * (variance - 0.005))));
  // The data's share is bounded by half of the variance.
  CHECK(bias_and_scatter({{1.1, 1}, {1.0, 1}}, 0.5).scatter ==
        Approx(bias_and_scatter({{1.1, 1}, {1.0, 1}}, 0.5).data_uncertainty));
  CHECK(std::isnan(bias_and_scatter({{1, 1}}, 0.1).bias));
  CHECK(std::isnan(bias_and_scatter({{1, 1}, {-1, 1}}, 0.1).bias));
}

TEST_CASE("Verdicts of a comparison", "[validation]") {
  // u_val of (0.1, 0.2, 0.2) is 0.3.
  const ComparedValue near{1.5, 1.0, 0.1, 0.2, 0.2};
  CHECK(near.validation_uncertainty() == Approx(0.3));
  CHECK(judge(near, 2, 0.7) == ValidationVerdict::Agrees);
  CHECK(judge(near, 2, 0.5) == ValidationVerdict::Inconclusive);
  CHECK(judge(near, 1, 0.7) == ValidationVerdict::ModelError);
  CHECK(bears(near, 1, 0.7));        // wrong by 0.5, which is borne
  CHECK_FALSE(bears(near, 1, 0.4));  // and here is not
  CHECK_FALSE(bears(near, 2, 0.5));  // never green by noise

  ComparedValue lost = near;
  lost.u_num = std::numeric_limits<double>::quiet_NaN();
  CHECK(judge(lost, 2, 10) == ValidationVerdict::Inconclusive);
  CHECK_FALSE(bears(lost, 2, 10));
  lost = near;
  lost.u_input = std::numeric_limits<double>::infinity();
  CHECK_FALSE(bears(lost, 2, 10));
  CHECK_THROWS_AS(judge(near, 0, 1), std::invalid_argument);
  CHECK_THROWS_AS(judge(near, 2, 0), std::invalid_argument);
  CHECK_THROWS_AS(judge({1, 1, -0.1, 0, 0}, 2, 1), std::invalid_argument);
}

TEST_CASE("Joint comparison", "[validation]") {
  // Independent: d^2 is the sum of squares; chi^2 of two degrees of freedom has Q = exp(-d^2/2).
  const JointComparison apart = compare_jointly({1, -2}, {1, 1}, {});
  CHECK(apart.distance_squared == Approx(5));
  CHECK(apart.p_value == Approx(std::exp(-2.5)));
  // Two values that only share one error of 3: the same shift of both is one surprise, not two ...
  CHECK(compare_jointly({3, 3}, {0.1, 0.1}, {{3, 3}}).distance_squared == Approx(1).epsilon(1e-3));
  // ... and a difference between them is what the shared error cannot explain.
  CHECK(compare_jointly({3, -3}, {0.1, 0.1}, {{3, 3}}).distance_squared == Approx(1800).epsilon(1e-3));
  CHECK(std::isnan(compare_jointly({1, 1}, {0, 0}, {{1, 1}}).p_value));  // singular
  CHECK_THROWS_AS(compare_jointly({}, {}, {}), std::invalid_argument);
  CHECK_THROWS_AS(compare_jointly({1}, {1}, {{1, 2}}), std::invalid_argument);
}

TEST_CASE("Latin hypercube: one value in every stratum, moments, same bits", "[validation]") {
  const std::vector<InputDistribution> inputs{
      {InputDistribution::Shape::Uniform, 0.5, 0.5 / std::numbers::sqrt3},
      {InputDistribution::Shape::Normal, 2, 0.1},
      {InputDistribution::Shape::LogNormal, 1, 0.2}};
  const auto samples = latin_hypercube(inputs, 200, 7);
  std::vector<bool> met(200, false);
  std::vector<double> second, third;
  for (const auto& row : samples) {
    met.at(static_cast<std::size_t>(row[0] * 200)) = true;
    second.push_back(row[1]);
    third.push_back(std::log(row[2]));
  }
  CHECK(std::count(met.begin(), met.end(), true) == 200);
  CHECK(moments(second).mean == Approx(2).margin(1e-3));
  CHECK(moments(second).deviation == Approx(0.1).epsilon(0.02));
  CHECK(moments(third).deviation == Approx(0.2).epsilon(0.02));
  CHECK(samples == latin_hypercube(inputs, 200, 7));
  CHECK(samples != latin_hypercube(inputs, 200, 8));
  CHECK_THROWS_AS(latin_hypercube(inputs, 1, 1), std::invalid_argument);
}

TEST_CASE("Synthetic truth: a right model is called wrong in about 5 % of the cases", "[validation]") {
  // Truth: flow rate q = F H^3/(12 nu), nu = 1. Each repetition draws the viscosity that the user believes
  // in, the error of the measurement and that of the grid from the distributions that are stated for them.
  const double u_nu = 0.03, u_data = 0.02, u_grid = 0.01;
  const auto draws = latin_hypercube({{InputDistribution::Shape::Normal, 1, u_nu},
                                      {InputDistribution::Shape::Normal, 0, u_data},
                                      {InputDistribution::Shape::Normal, 0, u_grid}},
                                     1000, 20260101);
  int wrong_called_wrong = 0, right_called_wrong = 0, jointly_rejected = 0;
  for (const auto& draw : draws) {
    const double nu = draw[0], believed = 1 / nu;
    const double u_input = u_nu / (nu * nu);  // |dq/dnu| u_nu where the user stands
    const ComparedValue right{believed + draw[2], 1 + draw[1], u_grid, u_input, u_data};
    right_called_wrong += judge(right, 2, 1) == ValidationVerdict::ModelError;
    ComparedValue wrong = right;
    wrong.simulated += 5 * right.validation_uncertainty();
    wrong_called_wrong += judge(wrong, 2, 1) == ValidationVerdict::ModelError;
    // Two measurements share the believed viscosity.
    const auto second = static_cast<std::size_t>(&draw - draws.data());
    const double other = draws[(second + 500) % draws.size()][1];
    jointly_rejected += compare_jointly({right.error(), right.simulated - 1 - other}, {u_data, u_data},
                                        {{u_input, u_input}, {u_grid, u_grid}})
                            .p_value < 0.05;
  }
  CHECK(right_called_wrong >= 30);  // 2 sigma of a normal: 4.55 %; asked for: 5 +- 2 %
  CHECK(right_called_wrong <= 70);
  CHECK(wrong_called_wrong >= 990);  // 5 - 2 = 3 sigma from the border: 99.9 %
  CHECK(jointly_rejected >= 30);
  CHECK(jointly_rejected <= 70);
}
