#include "verification/suite/run_cache.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

#include "reports/files/atomic_file.hpp"
#include "reports/files/content_hash.hpp"
#include "reports/files/io_error.hpp"
#include "solver/kernel/isa.hpp"
#include "verification/suite/build_identity.hpp"
#include "verification/suite/run_entry.hpp"

namespace verification {
namespace {

namespace fs = std::filesystem;

/// Folder of what foreign runs delivered, beside those of builds.
constexpr const char* foreign = "foreign";
// To be raised with any change of the bytes in a file; what is computed is part of the build's identity.
constexpr const char* format = "mpm-verify run, format 1\n";

/// All that decides the result of a run, as text.
std::string content_of(const Study& study, const PlannedRun& plan) {
  return fmt::format("compared with {}\nrepetitions {}\n{}",
                     std::to_string(static_cast<int>(study.comparison)) + study.table_content,
                     study.repetitions, plan.scene.toml);
}

std::string checksum_of(const std::string& body) {
  const std::uint64_t hash = reports::content_hash(body);
  std::string bytes(sizeof hash, '\0');
  std::memcpy(bytes.data(), &hash, sizeof hash);
  return bytes;
}

struct Entry {
  fs::path path;
  fs::file_time_type used;
  std::uintmax_t bytes;
};

/// Our own files in a directory, oldest first.
std::vector<Entry> files_in(const fs::path& directory) {
  std::vector<Entry> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    std::error_code gone;
    if (entry.path().extension() != ".run" || !reports::is_entry(entry.path(), format)) continue;  // not ours
    const auto bytes = entry.file_size(gone);
    const auto used = entry.last_write_time(gone);
    if (!gone) files.push_back({entry.path(), used, bytes});
  }
  std::ranges::sort(files, {}, &Entry::used);
  return files;
}

}  // namespace

RunCache::RunCache(const fs::path& directory, CacheUse use) : use_(use) {
  if (directory.empty()) use_ = CacheUse::Off;
  origins_.push_back({directory, build_identity(), mpm::current_isa()});
  open();
}

RunCache::RunCache(const CacheOrigin& origin) : use_(CacheUse::Reuse), origins_{origin} {
  open();
}

RunCache::RunCache(std::vector<CacheOrigin> origins) : use_(CacheUse::Only), origins_(std::move(origins)) {}

void RunCache::open() {
  const CacheOrigin& origin = origins_.front();
  if (origin.identity.empty()) use_ = CacheUse::Off;
  if (use_ == CacheUse::Off) return;
  runs_ = origin.directory / "runs";
  own_ = runs_ / origin.identity;
  std::error_code ignored;
  for (const fs::path& folder : {own_, runs_ / foreign}) {
    fs::create_directories(folder, ignored);
    fs::last_write_time(folder, fs::file_time_type::clock::now(), ignored);  // in use: prune() goes by this
  }
}

/// The text that decides something, with what decides everything: the build and its instruction set.
std::string RunCache::key_of(const std::string& content, const CacheOrigin& origin) const {
  return fmt::format("{}build {}\nkernels {}\n{}\n", format, origin.identity, origin.kernels, content);
}

fs::path RunCache::file_of(const std::string& key, const CacheOrigin& origin) const {
  return origin.directory / "runs" / origin.identity / (reports::content_name(key) + ".run");
}

fs::path RunCache::file(const Study& study, const PlannedRun& plan) const {
  if (plan.solver || !on()) return {};
  return file_of(key_of(content_of(study, plan), origins_.front()), origins_.front());
}

std::optional<std::string> RunCache::load(const std::string& content) const {
  for (const CacheOrigin& origin : origins_) {
    const std::string key = key_of(content, origin);
    if (auto bytes = load_from(file_of(key, origin), key)) return bytes;
  }
  return std::nullopt;
}

std::optional<std::string> RunCache::failure(const Study& study, const PlannedRun& plan) const {
  return load("failure of " + plan.run + "\n" + content_of(study, plan));
}

void RunCache::save_failure(const Study& study, const PlannedRun& plan, const std::string& why) {
  save("failure of " + plan.run + "\n" + content_of(study, plan), why);
}

std::optional<std::string> RunCache::load_from(const fs::path& file, const std::string& key) const {
  if (use_ != CacheUse::Reuse && use_ != CacheUse::Only) return std::nullopt;
  std::string bytes;
  try {
    bytes = reports::read_entry(file);
  } catch (const reports::IoError&) {
    return std::nullopt;
  }
  constexpr std::size_t checksum_size = sizeof(std::uint64_t);
  if (bytes.size() < key.size() + checksum_size || bytes.compare(0, key.size(), key) != 0)
    return std::nullopt;
  const std::string checksum = bytes.substr(bytes.size() - checksum_size);
  bytes.resize(bytes.size() - checksum_size);
  bytes.erase(0, key.size());
  if (checksum != checksum_of(bytes)) return std::nullopt;
  return bytes;
}

KeptDeliveries RunCache::deliveries() {
  KeptDeliveries kept;
  kept.may_run = may_run();
  if (!on()) return kept;
  const auto key_of_text = [](const std::string& text) { return format + ("foreign\n" + text + "\n"); };
  const auto file = [](const CacheOrigin& origin, const std::string& key) {
    return origin.directory / "runs" / foreign / (reports::content_name(key) + ".run");
  };
  kept.load = [this, key_of_text, file](const std::string& text) {
    const std::string key = key_of_text(text);
    std::optional<std::string> bytes;
    for (const CacheOrigin& origin : origins_)
      if (!bytes) bytes = load_from(file(origin, key), key);
    return bytes;
  };
  kept.save = [this, key_of_text, file](const std::string& text, const std::string& bytes) {
    const std::string key = key_of_text(text);
    save_to(file(origins_.front(), key), key, bytes);
  };
  return kept;
}

std::optional<RunData> RunCache::load(const Study& study, const PlannedRun& plan) const {
  if (plan.solver) return std::nullopt;
  const std::optional<std::string> bytes = load(content_of(study, plan));
  return bytes ? decode_run(*bytes, study, plan) : std::nullopt;
}

void RunCache::save(const std::string& content, const std::string& bytes) {
  const std::string key = key_of(content, origins_.front());
  save_to(file_of(key, origins_.front()), key, bytes);
}

void RunCache::save_to(const fs::path& file, const std::string& key, const std::string& bytes) {
  if (!on() || !may_run()) return;
  try {
    reports::write_file(file, key + bytes + checksum_of(bytes), reports::Durability::Unsynced);
    ++saved_;
  } catch (const reports::IoError& error) {
    if (lost_++ == 0) cause_ = error.error;
  }
}

void RunCache::save(const Study& study, const RunData& data) {
  if (!data.foreign) save(content_of(study, *data.plan), encode_run(data));
}

std::string RunCache::warning() const {
  return lost_ == 0
             ? ""
             : fmt::format(
                   "{} finished runs could not be kept in {} ({}): {}set MPM_CACHE to another directory; the "
                   "results are complete, only not remembered",
                   lost_.load(), runs_.string(), cause_ ? std::strerror(cause_) : "unknown cause",
                   cause_ == ENOSPC || cause_ == EDQUOT || cause_ == EFBIG ? "free some space there, or "
                                                                           : "");
}

void RunCache::prune(std::uintmax_t limit) const {
  if (!on() || saved_ == 0) return;
  struct Build {
    fs::path path;
    fs::file_time_type used;
    std::uintmax_t bytes;
  };
  std::vector<Build> others;
  std::uintmax_t total = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(runs_, error)) {
    std::error_code gone;
    if (entry.is_symlink(gone) || !entry.is_directory(gone)) continue;
    Build build{entry.path(), entry.last_write_time(gone), 0};
    for (const Entry& file : files_in(entry.path())) build.bytes += file.bytes;
    if (build.bytes == 0) continue;  // nothing of ours in it
    total += build.bytes;
    if (entry.path() != own_) others.push_back(build);
  }
  std::ranges::sort(others, {}, &Build::used);
  for (const Build& build : others) {
    if (total <= limit) return;
    std::error_code gone;
    for (const Entry& file : files_in(build.path)) fs::remove(file.path, gone);
    fs::remove(build.path, gone);  // which fails, as it should, when something of somebody else's is left
    total -= build.bytes;
  }
  for (const Entry& file : files_in(own_)) {
    if (total <= limit) return;
    std::error_code gone;
    fs::remove(file.path, gone);
    total -= file.bytes;
  }
}

}  // namespace verification
