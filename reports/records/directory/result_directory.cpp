#include "reports/records/directory/result_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "reports/files/atomic_file.hpp"
#include "reports/files/io_error.hpp"
#include "reports/records/provenance.hpp"

namespace reports {
namespace {

namespace fs = std::filesystem;

bool is_ours_or_empty(const fs::path& directory) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    // A log of ours comes first where we are somebody's foreign solver; nothing here writes to it.
    if (entry.path().filename() == ResultDirectory::lock_name || entry.path().filename() == "log.txt")
      continue;
    try {
      return read_provenance(directory).has_value();
    } catch (const IoError&) {
      return false;  // a provenance.json of somebody else's
    }
  }
  return true;
}

}  // namespace

ResultDirectory::ResultDirectory(const fs::path& directory, bool force) {
  ensure_directory(directory);
  if (!force && !is_ours_or_empty(directory))
    throw IoError(
        fmt::format("{} holds files that are no results of ours (it has no provenance.json of mpm-verify); "
                    "choose another "
                    "--out DIR, or overrule this with --force",
                    directory.string()));
  const fs::path file = directory / lock_name;
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK, 0666);
  if (descriptor_ < 0)
    throw IoError(
        fmt::format("cannot write {}: {}; choose another --out DIR", file.string(), std::strerror(errno)));
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  if (fcntl(descriptor_, F_SETLK, &lock) == 0) return;
  const int error = errno;
  // Some file systems know no locks: then there is none.
  if (error != EACCES && error != EAGAIN) return;
  struct flock other = lock;
  const bool known = fcntl(descriptor_, F_GETLK, &other) == 0 && other.l_type != F_UNLCK;
  close(descriptor_);
  throw IoError(fmt::format("another run is using {} (process {}); wait for it, or choose another --out DIR",
                            directory.string(), known ? std::to_string(other.l_pid) : "unknown"));
}

ResultDirectory::~ResultDirectory() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace reports
