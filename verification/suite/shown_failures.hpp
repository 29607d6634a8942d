#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "reports/records/records.hpp"

namespace verification {

/// What one of the outputs for people and machines shows of a suite.
struct Shown {
  std::string where;  ///< "console", "junit.xml", ...
  /// Failures that it lists, each by its name; NaN where its verdict or its totals do not fit the tables.
  double failures;
  double claims;  ///< that it calls not borne out; NaN where it shows none at all
};

/// Counts them as a reader would, in the files of a result directory and in what was printed beside them.
/// Whoever made the files is not asked: the counts come from the text alone, and are held against `results`.
std::vector<Shown> shown_failures(const std::filesystem::path& dir, const std::string& printed,
                                  const reports::Results& results);

}  // namespace verification
