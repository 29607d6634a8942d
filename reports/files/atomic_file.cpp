#include "reports/files/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "reports/files/io_error.hpp"

namespace reports {
namespace {

const char* remedy(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "free some space or choose another --out DIR";
    case ENOENT:
    case ENOTDIR:
      return "make the directory first or choose another --out DIR";
    default:
      return "choose another --out DIR";
  }
}

[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error) {
  throw IoError(fmt::format("cannot write {}: {}; {}", path.string(), std::strerror(error), remedy(error)),
                error);
}

// A file descriptor with the temporary file behind it; both are gone after a failure.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target) : target_(target) {
    static std::atomic<unsigned> serial{0};
    name_ = fmt::format("{}.{}.{}.tmp", target.string(), getpid(), serial++);
    descriptor_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail_to_write(target_, errno);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!committed_) unlink(name_.c_str());
  }

  void append(std::string_view content) {
    while (!content.empty()) {
      const ssize_t written = write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail_to_write(target_, errno);
      content.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void commit(Durability durability) {
    if (durability == Durability::Synced && fsync(descriptor_) != 0) fail_to_write(target_, errno);
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (close(descriptor) != 0) fail_to_write(target_, errno);
    if (rename(name_.c_str(), target_.c_str()) != 0) fail_to_write(target_, errno);
    committed_ = true;
  }

 private:
  std::filesystem::path target_;
  std::string name_;
  int descriptor_ = -1;
  bool committed_ = false;
};

/// Whether a name ends in a dot and digits.
bool ends_in_number(const std::filesystem::path& name) {
  const std::string extension = name.extension().string();
  return extension.size() > 1 && extension.find_first_not_of("0123456789", 1) == std::string::npos;
}

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view content, Durability durability) {
  TemporaryFile file(path);
  file.append(content);
  file.commit(durability);
}

bool is_temporary(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, error))) return false;
  // NAME.PROCESS.SERIAL.tmp
  const std::filesystem::path serial = path.stem(), process = serial.stem();
  return path.extension() == ".tmp" && ends_in_number(serial) && ends_in_number(process);
}

void keep_file(const std::filesystem::path& path, std::string_view content) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error) &&
      std::filesystem::file_size(path, error) == content.size() && !error) {
    try {
      if (read_file(path) == content) return;
    } catch (const IoError&) {
      // Not readable: written anew, or refused with a message of its own.
    }
  }
  write_file(path, content, Durability::Unsynced);
}

std::string read_entry(const std::filesystem::path& path) {
  struct stat facts {};
  if (lstat(path.c_str(), &facts) != 0)
    throw IoError(fmt::format("cannot read {}: {}", path.string(), std::strerror(errno)));
  if (!S_ISREG(facts.st_mode)) throw IoError(fmt::format("{} is no regular file", path.string()));
  return read_file(path);
}

bool is_entry(const std::filesystem::path& path, std::string_view header) {
  struct stat facts {};
  if (lstat(path.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode)) return false;
  const int descriptor = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;
  std::string begin(header.size(), '\0');
  const ssize_t got = read(descriptor, begin.data(), begin.size());
  close(descriptor);
  return got == static_cast<ssize_t>(header.size()) && begin == header;
}

std::string read_file(const std::filesystem::path& path) {
  const auto fail = [&](int error) -> std::string {
    throw IoError(fmt::format("cannot read {}: {}", path.string(), std::strerror(error)));
  };
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return fail(errno);
  struct stat facts {};
  if (fstat(descriptor, &facts) == 0 && S_ISCHR(facts.st_mode)) {  // /dev/zero has no end
    close(descriptor);
    return fail(EINVAL);
  }
  std::string content;
  char block[1 << 16];
  while (true) {
    const ssize_t got = read(descriptor, block, sizeof block);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      const int error = errno;
      close(descriptor);
      return fail(error);
    }
    if (got == 0) break;
    content.append(block, static_cast<std::size_t>(got));
  }
  close(descriptor);
  return content;
}

void ensure_directory(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) {
    throw IoError(fmt::format("cannot make directory {}: {}; choose another --out DIR", path.string(),
                              error.message()));
  }
  if (!std::filesystem::is_directory(path, error)) {
    throw IoError(fmt::format("{} is no directory; choose another --out DIR", path.string()));
  }
  if (access(path.c_str(), W_OK | X_OK) != 0) {
    throw IoError(fmt::format("cannot write into {}: {}; choose another --out DIR", path.string(),
                              std::strerror(errno)));
  }
}

}  // namespace reports
