#include "reports/files/atomic_file.hpp"

#include <filesystem>
#include <fstream>

#include "tests/catch.hpp"

TEST_CASE("a temporary file is known by its name: nothing of the user's is taken for one") {
  const std::filesystem::path dir = std::filesystem::temp_directory_path() / "mpm-verify-temporary-names";
  std::filesystem::remove_all(dir);
  std::filesystem::create_directories(dir);
  const auto is_one = [&](const char* name) {
    std::ofstream(dir / name) << "text";
    return reports::is_temporary(dir / name);
  };
  for (const char* name : {"errors.csv.12.3.tmp", "figure.12.3.tmp", "a b.1.0.tmp"}) {
    INFO(name);
    CHECK(is_one(name));
  }
  for (const char* name : {"errors.csv", "errors.tmp", "errors.3.tmp", "12.3.tmp", ".12.3.tmp", "a.x.3.tmp",
                           "a.12.x.tmp", "a.12..tmp", "a.12.3.tmpx", "a.12.3.TMP", "a.-1.3.tmp"}) {
    INFO(name);
    CHECK_FALSE(is_one(name));
  }
  std::filesystem::create_directory(dir / "d.12.3.tmp");
  CHECK_FALSE(reports::is_temporary(dir / "d.12.3.tmp"));
  CHECK_FALSE(reports::is_temporary(dir / "nothing.12.3.tmp"));
  std::filesystem::remove_all(dir);
}
