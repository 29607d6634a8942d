// Eca & Hoekstra, J. Comput. Phys. 262 (2014) 104-130.
//
// No published table that pairs grid data with the resulting p and U was found in public; the paper prints
// its data as figures. So the arithmetic is checked against least-squares solutions worked out by hand in
// exact fractions, one ladder a branch, and the procedure as a whole against published data: Roy's
// mixed-order pressures, whose converged values are known, and the digitised points of the paper's Fig. 9.
#include "verification/convergence/eca_hoekstra.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/catch.hpp"

using namespace verification;

namespace {

using Ladder = std::vector<double>;

/// Fits and derived numbers: round-off of small, well-scaled least-squares problems is below 1e-13.
Approx near(double value) {
  return Approx(value).epsilon(1e-11).margin(1e-12);
}

Ladder power_law(const Ladder& steps, double limit, double coefficient, double order) {
  Ladder values;
  for (double h : steps) values.push_back(limit + coefficient * std::pow(h, order));
  return values;
}

Ladder finest(const Ladder& ladder, std::size_t count) {
  return {ladder.end() - static_cast<std::ptrdiff_t>(count), ladder.end()};
}

}  // namespace

TEST_CASE("Eca-Hoekstra: smooth data of an order in range reduce to the GCI", "[convergence]") {
  const double order = GENERATE(0.5, 1.0, 1.3, 2.0);
  const Ladder steps{0.5, 0.3, 0.2, 0.1};
  const EcaHoekstraResult r = eca_hoekstra(steps, power_law(steps, 10.0, -3.0, order));
  // A p on the edge of the range may fall on either side of it by round-off; the safety factor then changes
  // only at 0.5. So 0.5 itself is tested for p alone.
  CHECK(r.convergence == Convergence::Monotone);
  CHECK(r.observed_order == Approx(order).epsilon(1e-10));
  CHECK(r.fit.limit == Approx(10.0).epsilon(1e-10));
  CHECK(r.fit.sigma < 1e-10);
  CHECK(r.data_range == near(3.0 * (std::pow(0.5, order) - std::pow(0.1, order)) / 3.0));
  if (order > 0.5) {
    CHECK(r.safety_factor == 1.25);
    CHECK(r.uncertainty == Approx(1.25 * 3.0 * std::pow(0.1, order)).epsilon(1e-8));
    // Any grid of the set, not only the finest.
    CHECK(eca_hoekstra(steps, power_law(steps, 10.0, -3.0, order), 2.0, 1).uncertainty ==
          Approx(1.25 * 3.0 * std::pow(0.3, order)).epsilon(1e-8));
  }
}

TEST_CASE("Eca-Hoekstra: a p above the formal order falls back to fixed orders", "[convergence]") {
  // phi = h^3 on h = 4, 3, 2, 1. By hand: of {h, h^2} x {equal, 1/h weights} the smallest sigma has h^2 with
  // the weights (3, 4, 6, 12)/25: phi_0 = -324/65, alpha = 105/26, sigma^2 = 6216/325 (the others: 2905/129,
  // 2592/29, 567/5). The fit at h = 1 is -123/130; Delta_phi = 63/3.
  const EcaHoekstraResult r = eca_hoekstra({4, 3, 2, 1}, {64, 27, 8, 1});
  CHECK(r.observed_order == Approx(3.0).epsilon(1e-10));
  CHECK(r.fit.model == ErrorModel::FormalOrder);
  CHECK(r.fit.weighted);
  CHECK(r.fit.limit == near(-324.0 / 65.0));
  CHECK(r.fit.amplitudes[0] == near(105.0 / 26.0));
  CHECK(r.fit.sigma == near(std::sqrt(6216.0 / 325.0)));
  CHECK(r.data_range == near(21.0));
  CHECK(r.safety_factor == 3.0);
  CHECK(r.error_estimate == near(105.0 / 26.0));
  CHECK(r.fit_residual == near(253.0 / 130.0));
  CHECK(r.uncertainty == near(3.0 * 105.0 / 26.0 + std::sqrt(6216.0 / 325.0) + 253.0 / 130.0));
}

TEST_CASE("Eca-Hoekstra: slightly above the formal order keeps the factor 1.25", "[convergence]") {
  // Published bounds: the fixed-order fits beyond 2, Fs = 3 only from 2.1 on.
  const Ladder steps{4, 3, 2, 1};
  const EcaHoekstraResult r = eca_hoekstra(steps, power_law(steps, 1.0, 0.1, 2.05));
  CHECK(r.fit.model == ErrorModel::FormalOrder);
  CHECK(r.safety_factor == 1.25);
  CHECK(eca_hoekstra(steps, power_law(steps, 1.0, 0.1, 2.15)).safety_factor == 3.0);
}

TEST_CASE("Eca-Hoekstra: a p below one half admits the two-term expansion", "[convergence]") {
  // phi = h^(1/4) on h = 256, 81, 16, 1. By hand, the smallest sigma of six: h + h^2, weighted 1/h:
  // phi_0 = 31846188/32545075, fit at h = 1 3980029/3905409, sigma^2 = 1487241216/29120031307; Delta_phi = 1.
  const EcaHoekstraResult r = eca_hoekstra({256, 81, 16, 1}, {4, 3, 2, 1});
  const double sigma = std::sqrt(1487241216.0 / 29120031307.0);
  const double fitted = 3980029.0 / 3905409.0;
  const double limit = 31846188.0 / 32545075.0;
  CHECK(r.observed_order == Approx(0.25).epsilon(1e-9));
  CHECK(r.convergence == Convergence::Monotone);
  CHECK(r.fit.model == ErrorModel::FirstAndFormalOrder);
  CHECK(r.fit.weighted);
  CHECK(r.fit.limit == near(limit));
  CHECK(r.fit.amplitudes[0] == near(31787111.0 / 781081800.0));
  CHECK(r.fit.amplitudes[1] == near(-29941.0 / 260360600.0));
  CHECK(r.fit.sigma == near(sigma));
  CHECK(r.safety_factor == 3.0);
  CHECK(r.uncertainty == near(3.0 * (fitted - limit) + sigma + (fitted - 1.0)));
}

TEST_CASE("Eca-Hoekstra: a negative order is anomalous", "[convergence]") {
  // phi = 12/h, p = -1 exactly. By hand, the smallest sigma of six: h + h^2, weighted: phi_0 = 101/5, terms
  // -48/5 and 67/50, fit at h = 1 597/50, sigma^2 = 216/625; Delta_phi = 3.
  const EcaHoekstraResult r = eca_hoekstra({4, 3, 2, 1}, {3, 4, 6, 12});
  CHECK(r.convergence == Convergence::Divergent);
  CHECK(std::isnan(r.observed_order));
  CHECK(r.fit.model == ErrorModel::FirstAndFormalOrder);
  CHECK(r.fit.weighted);
  CHECK(r.fit.limit == near(101.0 / 5.0));
  CHECK(r.fit.sigma == near(std::sqrt(216.0 / 625.0)));
  CHECK(r.safety_factor == 3.0);
  CHECK(r.uncertainty == near(3.0 * 413.0 / 50.0 + std::sqrt(216.0 / 625.0) + 3.0 / 50.0));
}

TEST_CASE("Eca-Hoekstra: scatter above the data range inflates the uncertainty", "[convergence]") {
  // Oscillating 0, 1, 0, 1: no power law with p > 0 beats passing through the finest point alone (p -> -inf),
  // so the six fits compete. By hand the smallest sigma: h, weighted: phi_0 = 32/29, alpha = -7/29, fit at h
  // = 1 25/29, sigma^2 = 48/145 > Delta_phi^2 = 1/9, hence eq. 21.
  const EcaHoekstraResult r = eca_hoekstra({4, 3, 2, 1}, {0, 1, 0, 1});
  const double sigma = std::sqrt(48.0 / 145.0);
  CHECK(r.convergence == Convergence::Divergent);
  CHECK(r.fit.model == ErrorModel::FirstOrder);
  CHECK(r.fit.weighted);
  CHECK(r.fit.limit == near(32.0 / 29.0));
  CHECK(r.fit.sigma == near(sigma));
  CHECK(r.data_range == near(1.0 / 3.0));
  CHECK(r.safety_factor == 3.0);
  CHECK(r.uncertainty == near(3.0 * sigma * 3.0 * (7.0 / 29.0 + sigma + 4.0 / 29.0)));
}

TEST_CASE("Eca-Hoekstra: the power-law fit is the global least-squares minimum", "[convergence]") {
  // Scattered data; a brute-force scan over p, with the closed regression formulas, finds nothing better.
  const Ladder steps{8, 6.4, 5.32, 4, 2.66, 2, 1};
  const Ladder values{2.95, 2.913, 2.872, 2.859, 2.868, 2.875, 2.888};
  const bool weighted = GENERATE(false, true);
  const GridFit fit = fit_power_law(steps, values, weighted);
  double least = std::numeric_limits<double>::infinity();
  double best = 0.0;
  double weight_sum = 0.0;
  for (double h : steps) weight_sum += weighted ? 1.0 / h : 1.0;
  for (int k = -12000; k <= 12000; ++k) {
    const double p = k / 1000.0;
    if (k == 0) continue;
    double x_mean = 0.0, y_mean = 0.0, sxx = 0.0, sxy = 0.0, syy = 0.0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const double w = (weighted ? 1.0 / steps[i] : 1.0) / weight_sum;
      x_mean += w * std::pow(steps[i], p);
      y_mean += w * values[i];
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const double w = (weighted ? 1.0 / steps[i] : 1.0) / weight_sum;
      const double x = std::pow(steps[i], p) - x_mean;
      sxx += w * x * x;
      sxy += w * x * (values[i] - y_mean);
      syy += w * (values[i] - y_mean) * (values[i] - y_mean);
    }
    const double squares = syy - sxy * sxy / sxx;
    if (squares < least) {
      least = squares;
      best = p;
    }
  }
  CHECK(fit.exponents[0] == Approx(best).margin(1e-3).epsilon(0.0));  // the width of the scan
  const double brute = std::sqrt(7.0 * least / (7.0 - 3.0));
  CHECK(fit.sigma <= brute * (1.0 + 1e-9));         // round-off of the brute-force sums
  CHECK(fit.sigma == Approx(brute).epsilon(1e-5));  // second order in the scan's distance from the minimum
}

TEST_CASE("Eca-Hoekstra: the uncertainty does not depend on units", "[convergence]") {
  const Ladder steps{8, 5, 3, 2, 1};
  const Ladder values{1.31, 1.17, 1.069, 1.034, 1.013};
  const EcaHoekstraResult r = eca_hoekstra(steps, values);
  Ladder scaled_steps, scaled_values;
  for (double h : steps) scaled_steps.push_back(1e-4 * h);
  for (double v : values) scaled_values.push_back(7.0 - 1e-6 * v);
  const EcaHoekstraResult s = eca_hoekstra(scaled_steps, scaled_values);
  // Differences of 1e-8 in values of 7 carry a relative round-off of 1e-8; ten times that.
  CHECK(s.observed_order == Approx(r.observed_order).epsilon(1e-7));
  CHECK(s.uncertainty == Approx(1e-6 * r.uncertainty).epsilon(1e-7));
  CHECK(s.fit.limit == Approx(7.0 - 1e-6 * r.fit.limit).epsilon(1e-13));
  CHECK(s.fit.at(2e-4) == Approx(7.0 - 1e-6 * r.fit.at(2.0)).epsilon(1e-13));
}

TEST_CASE("Eca-Hoekstra: formal orders other than two", "[convergence]") {
  const Ladder steps{5, 4, 3, 2, 1};
  const EcaHoekstraResult fourth = eca_hoekstra(steps, power_law(steps, 1.0, 0.01, 3.9), 4.0);
  CHECK(fourth.fit.model == ErrorModel::PowerLaw);
  CHECK(fourth.safety_factor == 1.25);
  CHECK(fourth.uncertainty == Approx(1.25 * 0.01).epsilon(1e-7));
  const EcaHoekstraResult first = eca_hoekstra(steps, power_law(steps, 1.0, 0.01, 1.5), 1.0);
  CHECK(first.fit.model == ErrorModel::FirstOrder);
  CHECK(first.safety_factor == 3.0);
}

TEST_CASE("Eca-Hoekstra: Roy's mixed-order pressures", "[convergence]") {
  // C. J. Roy, AIAA J. 41 (2003) 595-604: surface pressure (N/m^2) on a sphere-cone at x/R = 0.83 (Fig. 6)
  // and 0.23 (Fig. 8), grids h = 1 (finest) to 128, digitised points as given in ORNL's public cfd-verify;
  // the text states the converged values 1870 and 12980. First- and second-order terms of opposite sign
  // compete: not a power law.
  const Ladder steps{128, 64, 32, 16, 8, 4, 2, 1};
  const Ladder aft{3931.4490677801496, 2730.3208852926946, 2193.893485752481,  1974.5228809387208,
                   1898.3959687363088, 1885.0376512486057, 1879.7215083533931, 1874.4053654581828};
  const Ladder fore{13859.824442943956, 13302.36326806212,  12914.247130317352, 12911.006076975016,
                    12945.847400405131, 12962.052667116814, 12971.775827143822, 12979.06819716408};
  for (std::size_t grids : {4, 5, 8}) {
    CHECK(std::abs(aft.back() - 1870.0) <=
          eca_hoekstra(finest(steps, grids), finest(aft, grids)).uncertainty);
    CHECK(std::abs(fore.back() - 12980.0) <=
          eca_hoekstra(finest(steps, grids), finest(fore, grids)).uncertainty);
  }
}

TEST_CASE("Eca-Hoekstra: the paper's flat plate, three grid sets, one answer", "[convergence]") {
  // Eca & Hoekstra (2014), Fig. 9: friction coefficient (x 1e3) of a flat plate at Re = 1e7, Spalart-Allmaras
  // and SST models, grid sets A, B, C; digitised points as given in ORNL's public cfd-verify. The sets
  // approximate the same flow, so the intervals phi_1 +- U of a model must have a common point, though the
  // sets converge from different sides and some not monotonically.
  const Ladder steps{8, 6.4, 5.32, 4.56, 4, 3.2, 2.66, 2.28, 2, 1.6, 1.33, 1.14, 1};
  const std::vector<std::vector<Ladder>> models{
      {{2.80714548802947, 2.83381215469613, 2.8465561694291, 2.8539226519337, 2.85863720073665,
        2.86467771639042, 2.86777163904236, 2.86990791896869, 2.87093922651934, 2.87300184162063,
        2.87395948434622, 2.87469613259668, 2.8753591160221},
       {2.85097605893186, 2.85790055248619, 2.86290976058932, 2.86593001841621, 2.8679926335175,
        2.87042357274401, 2.87189686924494, 2.87278084714549, 2.87351749539595, 2.87432780847145,
        2.87506445672191, 2.8753591160221, 2.87587476979742},
       {2.87697974217311, 2.88198895027624, 2.88036832412523, 2.87882136279926, 2.8780847145488,
        2.8771270718232, 2.87639042357274, 2.87624309392265, 2.87609576427256, 2.87624309392265,
        2.87653775322284, 2.87646408839779, 2.8763167587477}},
      {{2.80951699463327, 2.83799642218247, 2.85481216457961, 2.86568872987478, 2.87234347048301,
        2.88014311270125, 2.88522361359571, 2.88872987477639, 2.89087656529517, 2.89402504472272,
        2.89567084078712, 2.89667262969589, 2.89745974955277},
       {2.83284436493739, 2.83878354203936, 2.84737030411449, 2.85445438282648, 2.86039355992844,
        2.86962432915921, 2.87599284436494, 2.88035778175313, 2.88357781753131, 2.8879427549195,
        2.89051878354204, 2.89230769230769, 2.89330948121646},
       {2.95, 2.91305903398927, 2.87212880143113, 2.86203935599284, 2.85932021466905, 2.86339892665474,
        2.86790697674419, 2.87191413237925, 2.87542039355993, 2.88042933810376, 2.88386404293381,
        2.88615384615385, 2.88787119856887}}};
  for (const std::vector<Ladder>& sets : models) {
    for (std::size_t grids : {5, 9, 13}) {
      double lower = -std::numeric_limits<double>::infinity();
      double upper = std::numeric_limits<double>::infinity();
      for (const Ladder& set : sets) {
        const EcaHoekstraResult r = eca_hoekstra(finest(steps, grids), finest(set, grids));
        lower = std::max(lower, set.back() - r.uncertainty);
        upper = std::min(upper, set.back() + r.uncertainty);
      }
      CHECK(lower <= upper);
    }
  }
  // The well-behaved set is seen as what it is, a second-order method in its range.
  const EcaHoekstraResult smooth = eca_hoekstra(steps, models[0][0]);
  CHECK(smooth.convergence == Convergence::Monotone);
  CHECK(smooth.fit.model == ErrorModel::PowerLaw);
  CHECK(smooth.safety_factor == 1.25);
}

TEST_CASE("Eca-Hoekstra: constant and invalid ladders", "[convergence]") {
  const EcaHoekstraResult constant = eca_hoekstra({4, 3, 2, 1}, {5, 5, 5, 5});
  CHECK(constant.convergence == Convergence::Floor);
  CHECK(constant.uncertainty == 0.0);
  CHECK(constant.fit.at(3.0) == 5.0);
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  const EcaHoekstraResult invalid = eca_hoekstra({4, 3, 2, 1}, {5, 4, bad, 3});
  CHECK(invalid.convergence == Convergence::Invalid);
  CHECK(std::isnan(invalid.uncertainty));
  CHECK(std::isnan(invalid.observed_order));
}

TEST_CASE("Eca-Hoekstra refuses bad arguments", "[convergence]") {
  const Ladder steps{4, 3, 2, 1};
  const Ladder values{4, 3, 2, 1};
  CHECK_THROWS_WITH(eca_hoekstra({3, 2, 1}, {3, 2, 1}), contains("at least 4"));
  CHECK_THROWS_WITH(eca_hoekstra({1, 2, 3, 4}, values), contains("decrease"));
  CHECK_THROWS_WITH(eca_hoekstra(steps, {3, 2, 1}), contains("one value"));
  CHECK_THROWS_WITH(eca_hoekstra(steps, values, 0.5), contains("formal order"));
  CHECK_THROWS_WITH(eca_hoekstra(steps, values, 2.0, 4), contains("level"));
  CHECK_THROWS_WITH(fit_power_law(steps, {3, 2, 1}, false), contains("one value"));
}
