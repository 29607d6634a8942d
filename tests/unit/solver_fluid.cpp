#include <cmath>

#include "solver/stress_update.hpp"
#include "tests/catch.hpp"

using namespace mpm;

TEST_CASE("the Tait pressure vanishes at rest, has stiffness 7 K/rho0 and grows with the seventh power") {
  const TaitPressure tait{143, 1e-3};
  CHECK(tait.pressure(1000) == 0);
  CHECK(tait.pressure(2000) == Approx(143 * 127).epsilon(1e-14));
  const double e = 1e-3;
  // Central difference, truncation 35 (e/rho0)^2 relative: far below the margin.
  CHECK((tait.pressure(1000 + e) - tait.pressure(1000 - e)) / (2 * e) ==
        Approx(7 * 143 / 1000.0).epsilon(1e-7));
  CHECK(tait.advance_density(1000, 0.5, 0.1) == Approx(1000 / 1.05).epsilon(1e-15));
  const Fluid fluid{1000, 143, true, Newtonian{1e-3}};
  CHECK(fluid.sound_speed() == Approx(std::sqrt(7 * 0.143)));
}

TEST_CASE("viscous stress is 2 mu D - (2/3) mu tr(D) I") {
  const Newtonian fluid{0.5};
  Mat2 shear;
  shear << 0, 1, 1, 0;
  CHECK((viscous_stress(fluid, shear) - shear).norm() < 1e-16);
  const Mat2 dilatation = Mat2::Identity();  // tr D = 2: 2 mu - (4/3) mu on the diagonal
  CHECK((viscous_stress(fluid, dilatation) - (1.0 / 3.0) * Mat2::Identity()).norm() < 1e-15);
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
