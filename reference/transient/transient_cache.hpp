#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/transient/gradient_history.hpp"

namespace reference {

/// What a computed transient is remembered by: its history with either resolution.
struct StoredTransient {
  std::vector<GradientHistory::Snapshot> fine, coarse;
};

/// The solution stored under `key` in `directory`, if there is one that is whole: file name, key text, format
/// version, size and checksum must all agree. Anything else, or an empty `directory`, is no solution. Never
/// throws for a bad file.
std::optional<StoredTransient> load_transient(const std::filesystem::path& directory, const std::string& key);

/// Stores a solution: written to a temporary file of its own, then renamed, so that readers and parallel
/// writers see whole files only. Does nothing for an empty `directory`; gives up quietly where it cannot
/// write, since a cache is a convenience.
void save_transient(const std::filesystem::path& directory, const std::string& key,
                    const StoredTransient& stored);

/// The file that `key` is stored in.
std::filesystem::path transient_file(const std::filesystem::path& directory, const std::string& key);

}  // namespace reference
