#include "verification/scene/scene_cost.hpp"

#include "tests/study_text.hpp"
#include "verification/config/config_error.hpp"

using namespace verification;

namespace {

SceneConfig scene_of(const std::string& text) {
  return read_scene_config(TomlTable::from_text(text, "scene.toml"));
}

void check_refused(const std::string& text, const std::string& key, const std::string& says) {
  CHECK_THROWS_AS(scene_of(text), ConfigError);
  CHECK_THROWS_WITH(scene_of(text), contains("scene.toml"));
  CHECK_THROWS_WITH(scene_of(text), contains(key));
  CHECK_THROWS_WITH(scene_of(text), contains(says));
}

}  // namespace

TEST_CASE("what no machine can hold or finish is refused when it is read, with the numbers") {
  check_refused(couette_scene("cells = 1000000000"), "'discretisation.cells'",
                "GiB of memory, and there are");
  check_refused(couette_scene("cells = 8\nparticles_across = 1000000000\nparticles_along = 1000000000"),
                "'discretisation.cells'", "8e+18 particles");
  check_refused(couette_scene("cells = 1000000000\ncells_along = 1000000000\nparticles_across = 1000000000"),
                "'discretisation.cells'", "particles on 1e+18 nodes");
  check_refused(couette_scene("cells = 10000", "dt = 1e-12\nend = 1e-1"), "'time'", "years at 20 million");
  check_refused(replaced(couette_scene(), "height = 1e-3", "height = 1e308"), "'scene.height'", "1e+308");
  check_refused(couette_scene("cells = 8", "dt = 2e-3\noutputs = [5e-324]"), "'time.outputs'", "5e-324");
  CHECK(scene_of(couette_scene("cells = 1000", "dt = 1e-7\nend = 1e-1")).particle_steps() == 4e9);
}

TEST_CASE("steps above a scheme's limit are told, and those below are not") {
  CHECK(step_warning(scene_of(couette_scene("cells = 8\ncells_along = 8"))).empty());
  // nu dt/h^2 = 0.128 a millisecond of 2: the limit is 0.6366, and 2.4 times that for a strip.
  CHECK(step_warning(scene_of(couette_scene("cells = 8", "dt = 0.02\nend = 1"))).empty());
  CHECK_THAT(step_warning(scene_of(couette_scene("cells = 8", "dt = 0.03\nend = 3"))),
             contains("nu dt/h^2 = 1.92"));
  CHECK_THAT(step_warning(scene_of(couette_scene("cells = 8\ncells_along = 8", "dt = 0.012\nend = 1.2"))),
             contains("known to be stable up to 0.637"));
  CHECK(step_warning(scene_of(couette_scene("cells = 8", "dt = 0.03\nend = 3") +
                              "[scheme]\nstepping = \"implicit-euler\"\n"))
            .empty());
  CHECK(step_warning(scene_of(replaced(couette_scene("cells = 8\ncells_along = 8", "dt = 0.012\nend = 1.2"),
                                       "pressure = false", "pressure = \"incompressible\"")))
            .empty());
}

TEST_CASE("implicit viscosity without a dt is stepped as accuracy asks, whatever the largest viscosity") {
  const std::string thinning =
      replaced(couette_scene("cells = 8", "outputs = [0.1, 0.3]"), "kinematic_viscosity = 1e-6",
               "model = \"power-law\"\nindex = 0.3\nkinematic_viscosity = 1e-6");
  const SceneConfig implicit = scene_of(thinning + "[scheme]\nstepping = \"implicit-euler\"\n");
  CHECK(implicit.steps() == 200 + 400);
  CHECK(implicit.segments.front().dt == Approx(0.1 / 200).epsilon(1e-12));
  // The explicit limit at the shear-rate floor of 1e-6/s: nu (1e-6)^-0.7.
  CHECK(scene_of(thinning).steps() > 1e6);
  // Sound bounds it still.
  const std::string sounding = replaced(thinning, "pressure = false", "bulk_modulus = 143");
  CHECK(scene_of(sounding + "[scheme]\nstepping = \"implicit-euler\"\n").segments.front().dt < 1.25e-4);
}

TEST_CASE("a step longer than the time between outputs is recorded as what is taken") {
  const SceneConfig scene = scene_of(couette_scene("cells = 8", "dt = 0.2\noutputs = [0.1, 0.25]"));
  CHECK(scene.steps() == 2);
  CHECK(scene.segments[0].dt == 0.1);
  CHECK(scene.segments[1].dt == Approx(0.15).epsilon(1e-14));
}
