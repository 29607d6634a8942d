#include "tests/catch.hpp"
#include "verification/config/config_error.hpp"
#include "verification/flows/surface/column_at_rest.hpp"
#include "verification/scene/scene_config.hpp"

using namespace verification;

namespace {

SceneConfig read(double height, const std::string& more = "") {
  return read_scene_config(TomlTable::from_text(R"(
[scene]
flow = "box"
width = 1.0
height = )" + std::to_string(height) + R"(
walls = { left = [0.0, 0.0], right = [0.0, 0.0], bottom = [0.0, 0.0], top = [0.0, 0.0] }
body_acceleration = [0.0, -1.0]
velocity_scale = 1.0
)" + more + R"(
[[scene.fluid_region]]
rectangle = [0.0, 0.0, 1.0, 0.5]
[fluid]
kinematic_viscosity = 1e-3
density = 1000.0
bulk_modulus = 1e5
[discretisation]
cells = 4
cells_along = 4
[scheme]
dilatation = "cell"
[time]
dt = 1e-3
outputs = [1.0]
)",
                                                "surface.toml"));
}

}  // namespace

TEST_CASE("a region of fluid that holds no particle is refused with file and key") {
  CHECK(read(1).particles() == 32);  // half of 16 cells of 4
  CHECK_THROWS_AS(read(1000), ConfigError);
  CHECK_THROWS_WITH(read(1000), contains("surface.toml"));
  CHECK_THROWS_WITH(read(1000), contains("scene.fluid_region"));
}

TEST_CASE("the surface of a fluid at rest lies in its box") {
  CHECK(read(1, "hydrostatic_surface = 0.5").particles() == 32);
  CHECK_THROWS_AS(read(1e-30, "hydrostatic_surface = 0.5"),
                  ConfigError);  // 2e30 cells of it under the surface
  CHECK_THROWS_WITH(read(1, "hydrostatic_surface = 1.01"), contains("scene.hydrostatic_surface"));
}

TEST_CASE("a column at rest costs nothing before a particle asks: what is too large is refused first") {
  // Its cells would not fit into any memory.
  CHECK_NOTHROW(density_at_rest({1, 1, 1e-13, 2}, mpm::Fluid{}));
}

TEST_CASE("what the reference of a flow refuses is refused with the scene") {
  const auto current = [](const std::string& index) {
    return read_scene_config(TomlTable::from_text(R"(
[scene]
flow = "gravity-current"
front = 4.0
aspect_ratio = 4.0
age = 1.0
[fluid]
model = "power-law"
index = )" + index + R"(
kinematic_viscosity = 1.27
shear_rate_floor = 0.01
largest_shear_rate = 60
density = 1000.0
bulk_modulus = 442432.3
[discretisation]
cells = 10
cells_along = 56
[scheme]
dilatation = "cell"
[time]
dt = 1e-3
outputs = [1.0]
)",
                                                  "current.toml"));
  };
  CHECK_NOTHROW(current("1.5"));
  CHECK_THROWS_AS(current("1e9"), ConfigError);
  CHECK_THROWS_WITH(current("1e9"), contains("current.toml"));
  CHECK_THROWS_WITH(current("1e9"), contains("gravity must be positive"));
}
