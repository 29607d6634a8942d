// The tables that a report and a comparison read, from any bytes: read, or refused with an IoError.

#include <cstddef>
#include <cstdint>
#include <string>

#include "reports/compare/compare.hpp"
#include "reports/files/io_error.hpp"
#include "reports/records/directory/run_files.hpp"
#include "tests/scratch_directory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ScratchDirectory scratch;
  static const bool made = std::filesystem::create_directory(scratch / "profiles");
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::string file = scratch.write("table.csv", text);
  static_cast<void>(made);
  try {
    static_cast<void>(reports::compare_results(file, file, {}));
  } catch (const reports::IoError&) {
  }
  scratch.write("profiles/run.csv", text);
  try {
    const auto rows = reports::read_profile(scratch.path(), "run");
    reports::write_profile(scratch.path(), "run", rows);
  } catch (const reports::IoError&) {
  }
  return 0;
}
