#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace reports {

/// Write `content` to `path` whole or not at all: into a temporary file of the same directory, checked,
/// flushed to disk and renamed over `path`. A reader sees the old file or the new one, never a part.
/// Unsynced leaves the flush to the system: enough for what outlives a killed program and may be made again
/// after a power cut, and a hundred times faster for thousands of small files.
/// @throws IoError after removing the temporary file; an existing `path` is then as it was.
enum class Durability { Synced, Unsynced };
void write_file(const std::filesystem::path& path, std::string_view content,
                Durability durability = Durability::Synced);

/// Write `content` unless the file holds these very bytes already; not flushed to disk. @throws IoError
void keep_file(const std::filesystem::path& path, std::string_view content);

/// The whole content of a file. @throws IoError if it is missing, a directory, or unreadable.
std::string read_file(const std::filesystem::path& path);

/// Whether this is a temporary file that write_file() of a killed program left: a regular file of that
/// naming.
bool is_temporary(const std::filesystem::path& path);

/// The bytes of an entry of a cache: a regular file, and no symbolic link. @throws IoError for anything else:
/// a FIFO or a device would never end.
std::string read_entry(const std::filesystem::path& path);

/// Whether that is a regular file, no link, that begins with `header`: one that we wrote and may delete.
bool is_entry(const std::filesystem::path& path, std::string_view header);

/// Make `path` and its parents, unless it is a directory already.
/// @throws IoError if that fails or `path` exists and is no directory.
void ensure_directory(const std::filesystem::path& path);

}  // namespace reports
