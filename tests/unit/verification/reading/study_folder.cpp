#include "verification/reading/study_folder.hpp"

#include <string>

#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"
#include "tests/study_text.hpp"
#include "verification/config/config_error.hpp"

using namespace verification;

namespace {

std::string good_study() {
  return study_text("T", "C", couette_scene()) + "[[check]]\nkind = \"error\"\nupper = 1\nreason = \"any\"\n";
}

}  // namespace

TEST_CASE("a folder of studies is read in the order of names, on any number of threads") {
  const ScratchDirectory scratch;
  for (const char* name : {"d", "a", "c", "b"}) scratch.write(std::string(name) + ".toml", good_study());
  for (const int threads : {0, 1, 3}) {
    std::string names;
    for (const Study& study : read_studies(scratch.path(), threads)) names += study.name;
    CHECK(names == "abcd");
  }
}

TEST_CASE("of several studies that are wrong, the first in the order of paths is named") {
  const ScratchDirectory scratch;
  for (int k = 0; k < 12; ++k)
    scratch.write("study-" + std::to_string(10 + k) + ".toml",
                  k < 4 ? good_study() : "unknown_key = 1\n" + good_study());
  for (const int threads : {0, 1, 2, 8}) try {
      (void)read_studies(scratch.path(), threads);
      FAIL("was read");
    } catch (const ConfigError& error) {
      INFO(error.what());
      CHECK(std::string(error.what()).find("study-14.toml") != std::string::npos);
    }
}
