#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/study/study.hpp"
#include "verification/suite/run_cache.hpp"

// What a plan, and a shard of it, say of themselves: manifest.json and shard.json.
namespace verification {

/// Which studies a plan is of, so that whoever reads it can read them again.
struct PlannedSuite {
  std::filesystem::path studies;   ///< directory
  std::vector<std::string> names;  ///< of studies, or absolute paths of their files; empty: the suite
  std::string suite;               ///< as the user said it, "" for nothing

  /// Paths of study files made absolute: a plan may be read from anywhere.
  static PlannedSuite of(const std::filesystem::path& studies, const std::vector<std::string>& names,
                         const std::string& suite);
};

/// One run of a plan.
struct PlannedEntry {
  std::string run, study;
  std::string scene;                  ///< file, relative to the manifest
  std::string key;                    ///< hash of that scene
  std::vector<std::string> delivers;  ///< files that whoever runs it must leave in results/RUN
  double seconds = 0;                 ///< estimated, on one core
  int shard = 0;                      ///< 1 ... Manifest::shards; 0 for none
};

struct Manifest {
  PlannedSuite suite;
  std::string program;  ///< program_identity() of whoever planned
  int shards = 0;       ///< 0: not cut
  std::vector<PlannedEntry> runs;
};

/// @throws reports::IoError
void write_manifest(const std::filesystem::path& directory, const Manifest& manifest);
/// Throws ConfigError for what is none.
Manifest read_manifest(const std::filesystem::path& directory);

/// How far a shard is. Its runs lie in cache/ beside shard.json.
struct ShardState {
  PlannedSuite suite;
  std::string program, kernels, machine;
  int index = 0, count = 0;
  long runs = 0;
  bool complete = false;  ///< every run has ended, or is known to be one that cannot be simulated
  std::vector<std::string> failures;
};

void write_shard(const std::filesystem::path& directory, const ShardState& state);
ShardState read_shard(const std::filesystem::path& directory);
/// Whether the shard in a directory is there and complete.
bool is_complete(const std::filesystem::path& directory);

/// Directories that hold a shard.json: each of `given`, or those right below it. Throws ConfigError for one
/// without any.
std::vector<std::filesystem::path> shard_directories(const std::vector<std::filesystem::path>& given);

/// Where the runs of a shard are kept, and of what kind they are.
CacheOrigin origin_of(const std::filesystem::path& directory, const ShardState& state);

}  // namespace verification
