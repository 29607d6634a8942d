#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "verification/runs/foreign/run_foreign.hpp"
#include "verification/runs/run_data.hpp"

namespace verification {

/// How a suite uses the cache of finished runs.
enum class CacheUse {
  Reuse,    ///< take what is there, add what is not
  Refresh,  ///< run everything, and replace what is there
  Only,     ///< take what is there; what is not may not be run
  Off       ///< neither read nor write
};

/// Runs of one directory that one kind of machine has made.
struct CacheOrigin {
  std::filesystem::path directory;
  std::string identity;      ///< of what computes
  std::string kernels = {};  ///< instruction set of the solver
};

/// Finished simulations, one file each, found by the content that decides them: the scene as read (every
/// value and the scheme), what the run is compared with, repetitions of its timing, and the identity of the
/// build that computes (build_identity()). Names of study and run take no part. Of somebody else's solver
/// what it delivered is kept (KeptDeliveries), under what decides it alone, whichever build of ours judges
/// it. Every file carries its key and a checksum; one that does not fit is as good as none. Threads and
/// processes may share a directory: files appear whole, by renaming.
class RunCache {
 public:
  /// Keeps runs below `directory`/runs; an empty directory is CacheUse::Off.
  RunCache(const std::filesystem::path& directory, CacheUse use);
  /// The runs of a shard, which other machines with the same program may take over: `origin` says of what.
  explicit RunCache(const CacheOrigin& origin);
  /// The runs of several shards, CacheUse::Only.
  explicit RunCache(std::vector<CacheOrigin> origins);

  /// The finished run with this content, if it is there and whole. Never throws for a bad file.
  [[nodiscard]] std::optional<RunData> load(const Study& study, const PlannedRun& plan) const;
  /// Bytes kept for what this text decides, likewise.
  [[nodiscard]] std::optional<std::string> load(const std::string& content) const;
  /// What foreign runs delivered.
  [[nodiscard]] KeptDeliveries deliveries();
  /// Keeps a run that completed or diverged. A disk that is full or cannot be written is noted, no failure.
  void save(const Study& study, const RunData& data);
  void save(const std::string& content, const std::string& bytes);

  /// Whether what is not there may be run.
  [[nodiscard]] bool may_run() const { return use_ != CacheUse::Only; }
  [[nodiscard]] bool on() const { return use_ != CacheUse::Off; }
  /// Why a run could not be simulated, where a shard found that out; and the note of it.
  [[nodiscard]] std::optional<std::string> failure(const Study& study, const PlannedRun& plan) const;
  void save_failure(const Study& study, const PlannedRun& plan, const std::string& why);

  /// One line on what could not be kept and why; "" if all is well.
  [[nodiscard]] std::string warning() const;
  /// Deletes what other builds left, least recently used first, until all builds together hold at most
  /// `limit` bytes; then, if need be, the oldest of our own. Touches only files that we wrote (by their
  /// ending and first line). Does nothing if nothing was saved.
  void prune(std::uintmax_t limit = default_limit) const;

  static constexpr std::uintmax_t default_limit = 1u << 30;

  /// The file in which a run is kept; "" for one that is not kept.
  [[nodiscard]] std::filesystem::path file(const Study& study, const PlannedRun& plan) const;

 private:
  void open();
  [[nodiscard]] std::string key_of(const std::string& content, const CacheOrigin& origin) const;
  [[nodiscard]] std::filesystem::path file_of(const std::string& key, const CacheOrigin& origin) const;
  [[nodiscard]] std::optional<std::string> load_from(const std::filesystem::path& file,
                                                     const std::string& key) const;
  void save_to(const std::filesystem::path& file, const std::string& key, const std::string& bytes);

  CacheUse use_;
  std::vector<CacheOrigin> origins_;  // the first is written to
  std::filesystem::path runs_, own_;  // <cache>/runs and <cache>/runs/<build>, of the first
  std::atomic<long> saved_{0}, lost_{0};
  std::atomic<int> cause_{0};  // errno of the first that was lost
};

}  // namespace verification
