// A scene from any bytes: read, or refused with a ConfigError. Anything else is a finding.

#include <cstddef>
#include <cstdint>
#include <string>

#include "verification/config/config_error.hpp"
#include "verification/scene/scene_config.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    using namespace verification;
    TomlTable root = TomlTable::from_text(text, "fuzzed.toml").restricted_to(scene_tables());
    const SceneConfig scene = read_scene_config(root);
    // What is written beside a result must read back.
    static_cast<void>(read_scene_config(TomlTable::from_text(scene.toml, "printed.toml")));
  } catch (const verification::ConfigError&) {
  }
  return 0;
}
