// A study from any bytes: read, or refused with a ConfigError. Anything else is a finding.

#include <cstddef>
#include <cstdint>
#include <string>

#include "reports/files/io_error.hpp"
#include "tests/scratch_directory.hpp"
#include "verification/config/config_error.hpp"
#include "verification/reading/study_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ScratchDirectory scratch;
  const std::string file =
      scratch.write("fuzzed.toml", std::string(reinterpret_cast<const char*>(data), size));
  try {
    static_cast<void>(verification::read_study(file).particle_steps());
  } catch (const verification::ConfigError&) {
  } catch (const reports::IoError&) {  // a table of measurements that is not there: exit code 2 as well
  }
  return 0;
}
