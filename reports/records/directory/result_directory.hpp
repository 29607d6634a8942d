#pragma once

#include <filesystem>

namespace reports {

/// A directory that results are written into: made if it is not there, and ours alone while this lives.
/// Another process that asks for it is refused; the lock goes with the process that holds it, however that
/// ends. Not copyable.
class ResultDirectory {
 public:
  /// @throws IoError for a directory that cannot be written, that another process writes into ("another run
  /// is using DIR (process N)"), and - unless `force` - for one that holds files, but no provenance.json of
  /// ours: they are somebody else's.
  explicit ResultDirectory(const std::filesystem::path& directory, bool force = false);
  ~ResultDirectory();
  ResultDirectory(const ResultDirectory&) = delete;
  ResultDirectory& operator=(const ResultDirectory&) = delete;

  /// The file that is locked; it stays, empty.
  static constexpr const char* lock_name = ".mpm-verify.lock";

 private:
  int descriptor_ = -1;
};

}  // namespace reports
