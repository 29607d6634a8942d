#include "tests/catch.hpp"
#include "verification/config/config_error.hpp"
#include "verification/flows/surface/column_at_rest.hpp"
#include "verification/scene/scene_config.hpp"

using namespace verification;

namespace {

/// A scene of a few cells from its tables scene and fluid.
SceneConfig read(const std::string& scene, const std::string& fluid) {
  const std::string rest = R"(
density = 1000.0
bulk_modulus = 1e6
[discretisation]
cells = 4
cells_along = 4
[scheme]
dilatation = "cell"
[time]
dt = 1e-3
outputs = [1.0]
)";
  return read_scene_config(
      TomlTable::from_text("[scene]\n" + scene + "\n[fluid]\n" + fluid + rest, "surface.toml"));
}

SceneConfig half_full_box(const std::string& height, const std::string& more = "") {
  return read("flow = \"box\"\nwidth = 1.0\nheight = " + height + R"(
walls = { left = [0.0, 0.0], right = [0.0, 0.0], bottom = [0.0, 0.0], top = [0.0, 0.0] }
body_acceleration = [0.0, -1.0]
velocity_scale = 1.0
)" + more + "\n[[scene.fluid_region]]\nrectangle = [0.0, 0.0, 1.0, 0.5]",
              "kinematic_viscosity = 1e-3");
}

SceneConfig gravity_current(const std::string& index) {
  return read(
      "flow = \"gravity-current\"\nfront = 4.0\naspect_ratio = 4.0\nage = 1.0",
      "model = \"power-law\"\nkinematic_viscosity = 1.27\nshear_rate_floor = 0.01\nlargest_shear_rate = "
      "60\nindex = " +
          index);
}

}  // namespace

TEST_CASE("a region of fluid that holds no particle is refused with file and key") {
  CHECK(half_full_box("1.0").particles() == 32);  // half of 16 cells of 4
  CHECK_THROWS_AS(half_full_box("1000.0"), ConfigError);
  CHECK_THROWS_WITH(half_full_box("1000.0"), contains("surface.toml") && contains("scene.fluid_region"));
}

TEST_CASE("the surface of a fluid at rest lies in its box") {
  CHECK(half_full_box("1.0", "hydrostatic_surface = 0.5").particles() == 32);
  CHECK_THROWS_WITH(half_full_box("1.0", "hydrostatic_surface = 1.01"),
                    contains("scene.hydrostatic_surface"));
  // 2e30 cells of it under the surface
  CHECK_THROWS_AS(half_full_box("1e-30", "hydrostatic_surface = 0.5"), ConfigError);
}

TEST_CASE("a column at rest costs nothing before a particle asks: what is too large is refused first") {
  // Its cells would not fit into any memory.
  CHECK_NOTHROW(density_at_rest({1, 1, 1e-13, 2}, mpm::Fluid{}));
}

TEST_CASE("what the reference of a flow refuses is refused with the scene") {
  CHECK_NOTHROW(gravity_current("1.5"));
  CHECK_THROWS_AS(gravity_current("1e9"), ConfigError);
  CHECK_THROWS_WITH(gravity_current("1e9"), contains("surface.toml") && contains("gravity must be positive"));
}
