#include "verification/scene/handed_scene.hpp"

#include "tests/catch.hpp"
#include "tests/study_text.hpp"
#include "verification/config/config_error.hpp"

using namespace verification;

TEST_CASE("a scene that is handed on reads back as the same scene, with nothing left out") {
  const std::string text = replaced(couette_scene("cells = 8", "cfl_viscous = 0.2\nend = 0.2"),
                                    "pressure = false", "bulk_modulus = 1e-3");
  const SceneConfig scene = read_scene_config(TomlTable::from_text(text, "scene"));
  const SceneConfig again = read_scene_config(TomlTable::from_text(handed_scene(scene, ""), "handed"));
  CHECK(again.outputs == scene.outputs);
  CHECK(again.segments.front().dt == scene.segments.front().dt);
  CHECK(again.particles() == scene.particles());
  CHECK(again.resolved == scene.resolved);  // there was no default left to write out
}

TEST_CASE("every flow says in words how it starts") {
  try {
    static_cast<void>(read_scene_config(
        TomlTable::from_text(replaced(couette_scene(), "flow = \"couette\"", "flow = \"none\""), "scene")));
    FAIL("a flow of no name was read");
  } catch (const ConfigError& error) {
    const std::string message = error.what(), mark = "choose one of: ";
    std::istringstream flows(message.substr(message.find(mark) + mark.size()));
    for (std::string flow; flows >> flow;) {
      if (flow.back() == ',') flow.pop_back();
      INFO(flow);
      CHECK_FALSE(start_in_words(flow).empty());
    }
  }
}

TEST_CASE("tables inside lists are printed, keys in quotes where they need them") {
  const std::string text = "a = [{b = 1, \"c d\" = [2.5, 3.0]}, {b = 2}]\n\"e f\" = \"g\"\n";
  CHECK(TomlTable::from_text(text, "text").print() == text);
}
