#include <algorithm>
#include <cmath>

#include "reference/cavity/benchmark_fluids.hpp"
#include "reference/cavity/cavity_features.hpp"
#include "reference/cavity/graded_volumes.hpp"
#include "reference/cavity/stream_function.hpp"
#include "reference/vortices/lid_driven_cavity.hpp"
#include "tests/catch.hpp"

using namespace reference;

namespace {

/// Largest distance to Marchi et al. on both centre lines.
template <class Flow>
double distance_to_marchi(const Flow& flow) {
  double largest = 0;
  for (const CavityPoint& point : marchi_2009(100))
    largest = std::max(
        largest,
        std::abs(flow.velocity(point.x, point.y)[static_cast<std::size_t>(point.component)] - point.value));
  return largest;
}

template <class Flow>
std::vector<CavityFeature> features(const Flow& flow) {
  return cavity_features({[&](double x, double y) { return flow.velocity(x, y); },
                          [&](double x, double y) { return flow.stream(x, y); }});
}

double value(const std::vector<CavityFeature>& features, const std::string& quantity) {
  return std::ranges::find(features, quantity, &CavityFeature::quantity)->value;
}

}  // namespace

TEST_CASE("splines of an axis add up to one, and their derivatives are those of what they interpolate",
          "[cavity]") {
  const SplineAxis axis(clustered_breaks(7, 2), 4);
  CHECK(axis.size() == 11);
  CHECK(axis.start(7) == 1);
  CHECK(axis.start(3) + axis.start(4) == Approx(1));
  for (const double x : {0.0, 1e-4, 0.3, 0.5, 0.99, 1.0}) {
    const auto local = axis.at(x);
    CHECK(local.of.row(0).sum() == Approx(1));
    CHECK(std::abs(local.of.row(1).sum()) < 1e-10);
    // The place itself has the Greville points as coefficients.
    double place = 0, slope = 0, bend = 0;
    for (int k = 0; k <= axis.degree(); ++k) {
      place += local.of(0, k) * axis.greville(local.first + k);
      slope += local.of(1, k) * axis.greville(local.first + k);
      bend += local.of(2, k) * axis.greville(local.first + k);
    }
    CHECK(place == Approx(x).margin(1e-14));
    CHECK(slope == Approx(1));
    CHECK(std::abs(bend) < 1e-8);
  }
  const auto here = axis.at(0.31), ahead = axis.at(0.31 + 1e-6), back = axis.at(0.31 - 1e-6);
  for (int k = 0; k <= axis.degree(); ++k) {
    CHECK((ahead.of(0, k) - back.of(0, k)) / 2e-6 == Approx(here.of(1, k)).margin(1e-7));
    CHECK((ahead.of(1, k) - back.of(1, k)) / 2e-6 == Approx(here.of(2, k)).margin(1e-6));
  }
  CHECK_THROWS_AS(SplineAxis({0, 0.5, 0.5, 1}, 3), std::invalid_argument);
}

TEST_CASE("the Newtonian cavity by splines is that of published tables, to a few 1e-6 with 36 spans",
          "[cavity]") {
  const CavityViscosity newtonian(NewtonianCurve{0.01});
  const CavityStreamFunction few(newtonian, {24, 4, 2}), more(newtonian, {36, 4, 2}, &few);
  // Measured 3.5e-5 and 6.3e-6, twice that.
  CHECK(distance_to_marchi(few) < 7e-5);
  CHECK(distance_to_marchi(more) < 1.3e-5);
  // Botella & Peyret, Comput. Fluids 27 (1998) 421; digits as printed.
  const auto found = features(more);
  CHECK(value(found, "u_min") == Approx(-0.2140424).margin(4e-6));
  CHECK(value(found, "v_max") == Approx(0.1795728).margin(4e-6));
  CHECK(value(found, "v_min") == Approx(-0.2538030).margin(4e-6));
  // No flow through walls; the lid.
  CHECK(std::abs(more.stream(0.3, 1)) < 1e-15);
  CHECK(more.velocity(0.3, 1)[0] == Approx(1));
}

TEST_CASE("finite volumes of the Newtonian cavity are of second order, on graded and on even meshes",
          "[cavity]") {
  const CavityViscosity newtonian(NewtonianCurve{0.01});
  for (const double clustering : {0.0, 0.7}) {
    const CavityGradedVolumes coarse(newtonian, 16, nullptr, clustering),
        fine(newtonian, 32, &coarse, clustering);
    CHECK(std::log2(distance_to_marchi(coarse) / distance_to_marchi(fine)) == Approx(1.95).margin(0.1));
  }
  CHECK_THROWS_AS(CavityGradedVolumes(newtonian, 9), std::invalid_argument);
}

TEST_CASE("two discretisations that share no operator agree on fluids that thin and thicken", "[cavity]") {
  for (const FlowCurve& curve : {FlowCurve(PowerLawCurve{0.01, 0.875}), FlowCurve(PowerLawCurve{0.01, 1.25}),
                                 FlowCurve(CrossCurve{0.01, 0.003, 1, 1})}) {
    const CavityViscosity start(NewtonianCurve{0.01}), viscosity(curve);
    const CavityStreamFunction rest(start, {16, 4, 2}), near(viscosity, {16, 4, 2}, &rest),
        splines(viscosity, {24, 4, 2}, &near);
    const CavityGradedVolumes still(start, 16), coarse(viscosity, 16, &still), middle(viscosity, 24, &coarse),
        fine(viscosity, 36, &middle);
    const auto a = features(splines), b = features(middle), c = features(fine);
    double largest = 0, unextrapolated = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i].quantity.size() > 1) continue;
      const double limit = c[i].value + (c[i].value - b[i].value) / (1.5 * 1.5 - 1);
      largest = std::max(largest, std::abs(limit - a[i].value));
      unextrapolated = std::max(unextrapolated, std::abs(c[i].value - a[i].value));
    }
    CAPTURE(curve.describe());
    CHECK(largest < 1.6e-3);                 // measured 8.2e-4 at most, on 24 and 36 cells; times 2
    CHECK(largest < 0.25 * unextrapolated);  // what they differ by is the volumes' own error, of second order
  }
}

TEST_CASE("the floor under the shear rate of a power law is felt by nothing that is published", "[cavity]") {
  const CavityStreamFunction::Mesh mesh{24, 4, 2};
  const CavityStreamFunction first(CavityViscosity(PowerLawCurve{0.01, 0.75}), mesh),
      start(CavityViscosity(PowerLawCurve{0.01, 0.625}), mesh, &first);
  const PowerLawCurve thin{0.01, 0.5};
  const auto a = features(CavityStreamFunction(CavityViscosity(thin, 1e-4), mesh, &start)),
             b = features(CavityStreamFunction(CavityViscosity(thin), mesh, &start));
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(std::abs(a[i].value - b[i].value) < 1e-7);
}

TEST_CASE("a fluid of the tables is known by its viscosity, whatever its units", "[cavity]") {
  const double side = 2e-3, lid = 5e-2;
  const auto* fluid =
      find_cavity_benchmark(PowerLawCurve{0.01 * std::pow(lid, 0.5) * std::pow(side, 1.5), 1.5}, lid, side);
  REQUIRE(fluid);
  CHECK(fluid->name == "power-law-1.5");
  CHECK(find_cavity_benchmark(CrossCurve{0.01, 0.1, 1, 1}, 1, 1)->name == "cross-10");
  CHECK_FALSE(find_cavity_benchmark(CrossCurve{0.01, 0.1, 2, 1}, 1, 1));
  CHECK_FALSE(find_cavity_benchmark(PowerLawCurve{0.011, 1.5}, 1, 1));
}
