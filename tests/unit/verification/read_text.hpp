#pragma once

#include <string>

#include "tests/scratch_directory.hpp"
#include "verification/reading/study_reader.hpp"

/// Reads a study from its text; its name is that of the file it is written to for the purpose.
inline verification::Study read_study_text(const std::string& text, const std::string& name = "tiny") {
  const ScratchDirectory scratch;
  return verification::read_study(scratch.write(name + ".toml", text));
}
