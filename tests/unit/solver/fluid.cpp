#include <cmath>

#include "solver/material/stress_update.hpp"
#include "tests/catch.hpp"

using namespace mpm;

TEST_CASE("the Tait pressure vanishes at rest, has stiffness 7 K/rho0 and grows with the seventh power") {
  const TaitPressure tait{143, 1e-3};
  CHECK(tait.pressure(1000.0) == 0);
  CHECK(tait.pressure(2000.0) == Approx(143 * 127).epsilon(1e-14));
  const double e = 1e-3;
  // Central difference, truncation 35 (e/rho0)^2 relative: far below the margin.
  CHECK((tait.pressure(1000 + e) - tait.pressure(1000 - e)) / (2 * e) ==
        Approx(7 * 143 / 1000.0).epsilon(1e-7));
  CHECK(tait.advance_density(1000.0, 0.5, 0.1) == Approx(1000 / 1.05).epsilon(1e-15));
  const Fluid fluid{1000, 143, true, Newtonian{1e-3}};
  CHECK(fluid.sound_speed() == Approx(std::sqrt(7 * 0.143)));
}

TEST_CASE("viscous stress is 2 mu D - (2/3) mu tr(D) I") {
  Mat2 shear;
  shear << 0, 1, 1, 0;
  CHECK((viscous_stress(0.5, shear) - shear).norm() < 1e-16);
  const Mat2 dilatation = Mat2::Identity();  // tr D = 2: 2 mu - (4/3) mu on the diagonal
  CHECK((viscous_stress(0.5, dilatation) - (1.0 / 3.0) * Mat2::Identity()).norm() < 1e-15);
}

TEST_CASE("a scene that cannot be simulated is refused") {
  const auto good = [] {
    Scene scene;
    scene.fluid.rheology = Newtonian{1e-3};
    return scene;
  };
  CHECK_NOTHROW(good().validate());
  Scene scene = good();
  scene.cells = {0, 1};
  CHECK_THROWS_AS(scene.validate(), SceneError);
  scene = good();
  scene.size.x() = NAN;
  CHECK_THROWS_AS(scene.validate(), SceneError);
  scene = good();
  scene.side(Edge::Left) = Side::wall(Vec2::Zero());
  CHECK_THROWS_WITH(scene.validate(), contains("face each other along x"));
  scene = good();
  scene.fluid.density = -1;
  CHECK_THROWS_AS(scene.validate(), SceneError);
  scene = good();
  scene.fluid.rheology = Newtonian{NAN};
  CHECK_THROWS_AS(scene.validate(), SceneError);
  CHECK_THROWS_WITH(stepping_named("ufs"), contains("usf, usl, musl, leapfrog"));
  CHECK(stepping_named(name(Scheme::Stepping::Musl)) == Scheme::Stepping::Musl);
}

TEST_CASE("viscosities follow their formulas, alike for one shear rate and for an array of them") {
  const double rates[] = {1e-9, 1e-3, 0.5, 1, 2, 8, 1e3};
  Eigen::Array<double, 7, 1> squared;
  for (int i = 0; i < 7; ++i) squared[i] = rates[i] * rates[i];
  const auto agree = [&](const auto& law, const auto& formula) {
    const Eigen::Array<double, 7, 1> mu = law.viscosity(squared);
    for (int i = 0; i < 7; ++i) {
      INFO("gdot = " << rates[i]);
      // exp(a log x) loses a few round-offs times |a log x| < 30.
      CHECK(mu[i] == Approx(formula(rates[i])).epsilon(1e-13));
      CHECK(law.viscosity(squared[i]) == Approx(formula(rates[i])).epsilon(1e-13));
    }
  };
  agree(Cross<SquareRoot>{2, 0.5, 3, {}}, [](double g) { return 0.5 + 1.5 / (1 + 3 * g); });
  agree(Cross<RealPower>{2, 0.5, 3, {0.35}}, [](double g) { return 0.5 + 1.5 / (1 + std::pow(3 * g, 0.7)); });
  agree(PowerLaw{2, 0.6, 1e-4, 0}, [](double g) { return 2 * std::pow(std::max(g, 1e-4), -0.4); });
  agree(PowerLaw{2, 1.4, 1e-4, 0}, [](double g) { return 2 * std::pow(std::max(g, 1e-4), 0.4); });
  agree(CarreauYasuda{2, 0.5, 3, 1.5, 0.4, 0},
        [](double g) { return 0.5 + 1.5 * std::pow(1 + std::pow(3 * g, 1.5), -0.6 / 1.5); });
  for (const double n : {0.6, 1.0, 1.4})
    agree(HerschelBulkley{2, n, 0.5, 100, 1e-4, 0},
          [n](double g) { return 2 * std::pow(std::max(g, 1e-4), n - 1) - 0.5 * std::expm1(-100 * g) / g; });
}

TEST_CASE("the regularised yield stress loses no digit, on either side of where its two forms meet") {
  CHECK(mean_of_decay(0.0) == 1);
  for (double x = 1e-9; x < 800; x *= 1.01) {
    INFO("x = " << x);
    CHECK(mean_of_decay(x * x) == Approx(-std::expm1(-x) / x).epsilon(1e-15));
  }
  for (const double x : {1 - 1e-15, 1.0, 1 + 1e-15})
    CHECK(mean_of_decay(x * x) == Approx(1 - std::exp(-1.0)).epsilon(1e-15));
}

TEST_CASE("Newtonian limits are exact, and zero shear is finite") {
  CHECK(Cross<SquareRoot>{2, 2, 3, {}}.viscosity(7.3) == 2);
  CHECK(PowerLaw{2, 1, 1e-4, 0}.viscosity(7.3) == 2);
  CHECK(PowerLaw{2, 1, 1e-4, 0}.viscosity(0.0) == 2);
  CHECK(CarreauYasuda{2, 0.5, 3, 2, 1, 0}.viscosity(7.3) == 2);
  CHECK(Cross<SquareRoot>{2, 0.5, 3, {}}.viscosity(0.0) == 2);
  CHECK(Cross<RealPower>{2, 0.5, 3, {0.35}}.viscosity(0.0) == 2);
  CHECK(CarreauYasuda{2, 0.5, 3, 2, 0.5, 0}.viscosity(0.0) == 2);
  CHECK(std::isfinite(PowerLaw{2, 0.2, 1e-6, 0}.viscosity(0.0)));
  CHECK(HerschelBulkley{2, 1, 0.5, 100, 1e-4, 0}.viscosity(0.0) == 52);
  CHECK(HerschelBulkley{2, 1, 0, 100, 1e-4, 0}.viscosity(7.3) == 2);
}

TEST_CASE("the largest viscosity bounds what the fluid shows, and the tangent of a thickening power law") {
  CHECK(Cross<SquareRoot>{2, 8, 3, {}}.largest_viscosity() == 8);
  CHECK(PowerLaw{2, 0.5, 1e-4, 0}.largest_viscosity() == Approx(200));
  CHECK(PowerLaw{2, 2, 1e-4, 5}.largest_viscosity() == Approx(20));  // tau = 2 gdot^2, slope 4 gdot
  CHECK(CarreauYasuda{2, 0.5, 3, 2, 0.5, 0}.largest_viscosity() == 2);
  CHECK(HerschelBulkley{2, 1, 0.5, 100, 1e-4, 0}.largest_viscosity() == 52);
  CHECK(HerschelBulkley{2, 0.5, 0.5, 100, 1e-4, 0}.largest_viscosity() == Approx(250));
}
