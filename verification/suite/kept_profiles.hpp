#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "verification/runs/run_data.hpp"

namespace verification {

/// Which files of profiles/ a suite leaves behind. All of them are a quarter of a gigabyte for a full suite,
/// and nobody looks at most of them again.
enum class Profiles {
  Needed,  ///< those that a figure draws, and every one of a study that fails
  All,
};

/// Writes the profiles, histories, shear rates and states of runs as far as they are wanted; what an earlier
/// suite left of the others is removed, so that no file stands beside a table that it does not belong to.
class KeptProfiles {
 public:
  KeptProfiles(const std::vector<Study>& studies, std::filesystem::path out, Profiles kept);

  /// As a run ends. @throws reports::IoError
  void write(const RunData& run) const;
  /// When its study has failed: all of it. @throws reports::IoError
  void write_all(const RunData& run) const;

 private:
  enum class File { Profile, History, Shear, State };
  [[nodiscard]] bool wanted(const std::string& run, File file) const;
  void write(const RunData& run, bool all) const;

  std::filesystem::path out_;
  Profiles kept_;
  std::map<std::string, std::set<File>> drawn_;  // by run
};

}  // namespace verification
