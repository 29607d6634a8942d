#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/study/study.hpp"

// A directory of studies: *.toml in folders by topic, and chapters.csv, which says how the report names them.
namespace verification {

/// Every study of a directory and its folders, by name. A study's topic is the first folder that it lies in,
/// unless it names another. Files are read on so many threads, 0: one a core; what is wrong is said of the
/// first of them in the order of paths. Throws ConfigError when there is none, or two of one name.
std::vector<Study> read_studies(const std::filesystem::path& directory, int threads = 0);

/// The study of that name, wherever it lies in the directory. Throws ConfigError.
Study read_study_named(const std::filesystem::path& directory, const std::string& name);

/// Where studies lie if nobody says so: $MPM_STUDIES, else beside an installed program
/// (../share/mpm-verify/studies), else `source`, where the program was built. Throws ConfigError, naming them
/// all, when none of them is a directory.
std::filesystem::path studies_directory(const std::filesystem::path& source);

}  // namespace verification
